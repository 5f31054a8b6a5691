// SPDX-License-Identifier: Apache-2.0
//
// Cells become one mesh, each with vertices of its own and as a group of faces, or each a file.
#include "apps/minkowski/command/write_cells.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "nef/base/counted.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/recenter.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// Cell number `first` and those that follow it. Segments and points are lines and points, where the format has them.
void write_mesh_file(const std::string& path, std::span<const ConvexCell> cells, std::size_t first,
                     const MeshFormat& format, const CellFiles& files, const Rational3& offset) {
  Mesh all;
  MeshWriteOptions how{
      .exact = files.exact, .binary = files.binary, .format = std::string(format.extension), .offset = offset};
  for (const ConvexCell& cell : cells) {
    if (cell.dimension < 2 && !format.has(kWires)) continue;
    const auto begin = static_cast<std::uint32_t>(all.vertices.size());
    for (const Rational3& p : cell.mesh.vertices) all.vertices.push_back(minus(p, offset));
    if (cell.dimension == 1) how.lines.push_back({begin, begin + 1});
    if (cell.dimension == 0) how.points.push_back(begin);
    if (cell.dimension < 2) continue;
    for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
      for (const std::uint32_t v : cell.mesh.face(f)) all.corners.push_back(begin + v);
      all.face_begin.push_back(static_cast<std::uint32_t>(all.corners.size()));
      how.groups.of_face.push_back(static_cast<std::uint32_t>(how.groups.names.size()));
    }
    how.groups.names.push_back("cell_" + std::to_string(first + static_cast<std::size_t>(&cell - cells.data()) + 1));
  }
  write_mesh(path, all, how);
}

Rational3 middle_of(std::span<const ConvexCell> cells) {
  std::vector<Rational3> points;
  for (const ConvexCell& cell : cells) {
    points.insert(points.end(), cell.mesh.vertices.begin(), cell.mesh.vertices.end());
  }
  return middle_of_few_digits(points);
}

// What is wrong with solid cells as they are written; empty if nothing is.
std::string problem_of_rounded(const std::string& path, std::span<const ConvexCell> cells, const Rational3& offset,
                               FileNumbers numbers) {
  std::string first;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].dimension < 3) continue;
    Mesh mesh = cells[i].mesh;
    for (Rational3& p : mesh.vertices) p = minus(p, offset);
    const std::string problem = rounded_problem(mesh, rounding_to(numbers));
    if (problem.empty()) continue;
    if (++count == 1) first = "cell " + std::to_string(i + 1) + ": " + problem;
  }
  if (count == 0) return {};
  return path + ": " + counted(count, "cell is", "cells are") + " no solid any more with rounded coordinates (" +
         first + ")";
}

std::string cell_path(const std::string& directory, std::size_t cell, const std::string& format) {
  std::string digits = std::to_string(cell + 1);
  digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
  return (std::filesystem::path(directory) / ("cell_" + digits + "." + format)).string();
}

// A cell of an earlier run, of whatever format, that this one would leave among its own; empty if there is none.
std::string stale_cell(const std::string& directory, std::size_t cells, const std::string& format) {
  std::set<std::string> written;
  for (std::size_t i = 0; i < cells; ++i) written.insert(cell_path(directory, i, format));
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("cell_", 0) != 0 || !is_file_extension(lower_extension(name))) continue;
    if (written.count(entry.path().string()) > 0) continue;
    if (first.empty() || name < first) first = name;
  }
  return first;
}

}  // namespace

WrittenFile write_cells(const std::string& path, std::span<const ConvexCell> cells, const CellFiles& files,
                        Messages& messages) {
  std::error_code unknown;
  const bool is_directory = std::filesystem::is_directory(path, unknown) || lower_extension(path).empty();
  const std::string extension = is_directory ? files.format : lower_extension(path);
  const MeshFormat* format = find_mesh_format(extension);
  if (format == nullptr && !is_directory) {
    throw InputError(path + ": cells go to a mesh (" + mesh_format_extensions() +
                     "), or into a directory (a path without extension)");
  }
  if (files.recenter && format == nullptr) {
    throw UnsupportedError("--recenter applies to mesh files; cells in .nef files keep their place");
  }
  const auto thin = std::count_if(cells.begin(), cells.end(), [](const ConvexCell& c) { return c.dimension < 2; });
  if (thin > 0 && format != nullptr && !format->has(kWires)) {
    messages.push_back(path + ": " + std::to_string(thin) + " of the cells are segments or points, which " +
                       std::string(format->name) + " cannot store; write " + mesh_format_names(kWires) + " or .nef");
  }
  WrittenFile written{.offset = files.recenter ? middle_of(cells) : Rational3{}};
  if (!files.exact && format != nullptr) {
    written.problem = problem_of_rounded(path, cells, written.offset, format->numbers(files.binary));
  }
  if (!written.problem.empty() && !files.lenient) {
    throw UnsupportedError(written.problem + "; --exact writes them exactly, --lenient as they are");
  }
  if (!is_directory) {
    write_mesh_file(path, cells, 0, *format, files, written.offset);
    return written;
  }
  make_folder(path);
  if (const std::string stale = stale_cell(path, cells.size(), extension); !stale.empty()) {
    throw InputError(path + ": contains " + stale + " of an earlier run; empty it or name another folder");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string file = cell_path(path, i, extension);
    if (format == nullptr) {
      write_polyhedron(file, to_polyhedron(cells[i]));
    } else if (format->has(kWires) || cells[i].dimension >= 2) {
      write_mesh_file(file, cells.subspan(i, 1), i, *format, files, written.offset);
    }
  }
  return written;
}

}  // namespace nef::minkowski
