// SPDX-License-Identifier: Apache-2.0
#include "apps/nef_mpi/piece_list.h"

#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/nef_mpi/work_folder.h"
#include "apps/program/expression/expression.h"
#include "nef/io/file_bytes.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::mpi {

PieceList::PieceList(std::vector<std::string> files, const std::string& list, const MeshOptions& options)
    : files_(std::move(files)), list_(list), options_(options) {
  if (list.empty()) return;
  std::istringstream text(read_file(list));
  Line line;
  for (line.number = 1; std::getline(text, line.expression); ++line.number) {
    if (is_blank_expression(line.expression)) continue;
    try {
      line.files = files_of_expression(line.expression);
    } catch (const InputError& error) {
      throw InputError(place(line) + error.what());
    }
    for (std::string& file : line.files) file = path_of(file);
    lines_.push_back(line);
  }
}

std::string PieceList::path_of(const std::string& file) const {
  return (std::filesystem::path(list_).parent_path() / file).string();
}

std::string PieceList::place(const Line& line) const { return list_ + ":" + std::to_string(line.number) + ": "; }

Polyhedron PieceList::set(std::uint32_t piece, const Monitor& monitor) const {
  MeshOptions mesh = options_;
  mesh.monitor = monitor;
  if (piece < files_.size()) return read_file_or_tiles(files_[piece], mesh);
  const Line& line = lines_[piece - files_.size()];
  ExpressionOptions options;
  options.load = [&](const std::string& file, const Monitor&) { return read_file_or_tiles(path_of(file), mesh); };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& own) {
    return minkowski::minkowski_sum(a, b, {.monitor = own});
  };
  options.monitor = monitor;
  try {
    return evaluate_expression(line.expression, options);
  } catch (const InputError& error) {
    throw InputError(place(line) + error.what());
  }
}

std::string PieceList::identity() const {
  std::string result;
  for (const std::string& file : files_) result += file_identity(file);
  std::set<std::string> known;
  for (const Line& line : lines_) {
    // Spelled with its length, so that no expression looks like what comes after it.
    result += std::to_string(line.expression.size()) + " " + line.expression + "\n";
    for (const std::string& file : line.files) {
      if (!known.insert(file).second) continue;
      try {
        result += file_identity(file);
      } catch (const InputError& error) {
        throw InputError(place(line) + error.what());
      }
    }
  }
  return result;
}

}  // namespace nef::mpi
