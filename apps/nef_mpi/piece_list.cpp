// SPDX-License-Identifier: Apache-2.0
#include "apps/nef_mpi/piece_list.h"

#include <filesystem>
#include <sstream>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/nef_mpi/work_folder.h"
#include "nef/io/file_bytes.h"
#include "nef/program/expression/expression.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::mpi {

PieceList::PieceList(std::vector<std::string> files, const std::string& list, const MeshOptions& options)
    : files_(std::move(files)), list_(list), options_(options) {
  if (list.empty()) return;
  std::istringstream text(read_file(list));
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    const std::string expression = line.substr(0, line.find('#'));
    if (expression.find_first_not_of(" \t\r") != std::string::npos) lines_.push_back({number, expression});
  }
}

Polyhedron PieceList::set(std::uint32_t piece, const Monitor& monitor) const {
  MeshOptions mesh = options_;
  mesh.monitor = monitor;
  if (piece < files_.size()) return read_file_or_tiles(files_[piece], mesh);
  const Line& line = lines_[piece - files_.size()];
  const std::filesystem::path folder = std::filesystem::path(list_).parent_path();
  ExpressionOptions options;
  options.load = [&](const std::string& file, const Monitor&) {
    return read_file_or_tiles((folder / file).string(), mesh);
  };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& own) {
    minkowski::MinkowskiOptions sum;
    sum.monitor = own;
    return minkowski::minkowski_sum(a, b, sum);
  };
  options.monitor = monitor;
  try {
    return evaluate_expression(line.expression, options);
  } catch (const InputError& error) {
    throw InputError(list_ + ":" + std::to_string(line.number) + ": " + error.what());
  }
}

std::string PieceList::text() const {
  std::string result;
  for (const std::string& file : files_) result += file_state(file);
  if (!list_.empty()) result += file_state(list_);
  return result;
}

}  // namespace nef::mpi
