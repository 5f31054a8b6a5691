// SPDX-License-Identifier: Apache-2.0
//
// Cells are written one after another into the lists of vertices and faces of one file, with indices shifted by the
// vertices before, or each to a file of its own. Colours are hues a golden angle apart, so that cells with near numbers
// differ.
#include "apps/minkowski/command/write_cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "nef/base/counted.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/recenter.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

using Colour = std::array<int, 3>;

// Hues a golden angle apart, so that cells with near numbers differ.
Colour colour_of(std::size_t cell) {
  const double hue = std::fmod(static_cast<double>(cell) * 0.61803398875, 1.0) * 6;
  Colour colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double distance = std::fabs(std::fmod(hue + 6 - 2.0 * static_cast<double>(i), 6) - 3) - 1;
    colour[i] = static_cast<int>(std::lround(70 + 175 * std::min(1.0, std::max(0.0, distance))));
  }
  return colour;
}

std::string number(const Rational& value, bool exact) {
  if (exact) return to_string(value);
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), nearest_double(value)).ptr;
  return {text.data(), end};
}

std::string point_line(const Rational3& p, bool exact) {
  return number(p[0], exact) + " " + number(p[1], exact) + " " + number(p[2], exact) + "\n";
}

// The faces of a cell as vertex lists; a segment or a point counts as a face with two corners or one.
std::vector<std::vector<std::uint32_t>> faces_of(const ConvexCell& cell) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    const auto face = cell.mesh.face(f);
    faces.emplace_back(face.begin(), face.end());
  }
  if (cell.dimension == 1) faces.push_back({0, 1});
  if (cell.dimension == 0) faces.push_back({0});
  return faces;
}

struct Bodies {
  std::string points, faces;
  std::size_t point_count = 0, face_count = 0;
};

// How coordinates are written.
struct Coordinates {
  bool exact = false;
  Rational3 offset = {};  // is subtracted
};

// The vertices and faces of all cells that `format` holds, in its notation.
Bodies bodies(std::span<const ConvexCell> cells, std::size_t first, const std::string& format,
              const Coordinates& coordinates) {
  Bodies b;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (format == "ply" && cells[i].dimension < 2) continue;
    const Colour colour = colour_of(first + i);
    const std::string rgb =
        std::to_string(colour[0]) + " " + std::to_string(colour[1]) + " " + std::to_string(colour[2]);
    for (const Rational3& p : cells[i].mesh.vertices) {
      b.points += (format == "obj" ? "v " : "") + point_line(minus(p, coordinates.offset), coordinates.exact);
    }
    if (format == "obj") b.faces += "g cell_" + std::to_string(first + i + 1) + "\n";
    for (const std::vector<std::uint32_t>& face : faces_of(cells[i])) {
      b.faces += format != "obj" ? std::to_string(face.size()) : face.size() > 2 ? "f" : face.size() == 2 ? "l" : "p";
      for (const std::uint32_t v : face) {
        b.faces += " " + std::to_string(b.point_count + v + (format == "obj" ? 1 : 0));
      }
      b.faces += format == "obj" ? "\n" : " " + rgb + "\n";
      ++b.face_count;
    }
    b.point_count += cells[i].mesh.vertices.size();
  }
  return b;
}

void write_mesh_file(const std::string& path, std::span<const ConvexCell> cells, std::size_t first,
                     const std::string& format, const Coordinates& coordinates) {
  const Bodies b = bodies(cells, first, format, coordinates);
  std::string head;
  if (format == "off") {
    head = "OFF\n" + std::to_string(b.point_count) + " " + std::to_string(b.face_count) + " 0\n";
  } else if (format == "ply") {
    head = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(b.point_count) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(b.face_count) +
           "\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nend_header\n";
  } else if (format != "obj") {
    throw InputError(path + ": cells go to off, ply or obj, or into a directory (a path without extension)");
  }
  write_file(path, head + b.points + b.faces);
}

Rational3 middle_of(std::span<const ConvexCell> cells) {
  std::vector<Rational3> points;
  for (const ConvexCell& cell : cells) {
    points.insert(points.end(), cell.mesh.vertices.begin(), cell.mesh.vertices.end());
  }
  return middle_of_few_digits(points);
}

// What is wrong with solid cells as they are written; empty if nothing is.
std::string problem_of_rounded(const std::string& path, std::span<const ConvexCell> cells, const Rational3& offset) {
  std::string first;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].dimension < 3) continue;
    Mesh mesh = cells[i].mesh;
    for (Rational3& p : mesh.vertices) p = minus(p, offset);
    const std::string problem = rounded_problem(mesh, rounding_to_decimals());
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
    const std::string extension = entry.path().extension().string();
    const bool is_format = extension == ".off" || extension == ".ply" || extension == ".obj" || extension == ".nef";
    if (name.rfind("cell_", 0) != 0 || !is_format || written.count(entry.path().string()) > 0) continue;
    if (first.empty() || name < first) first = name;
  }
  return first;
}

}  // namespace

WrittenFile write_cells(const std::string& path, std::span<const ConvexCell> cells, const CellFiles& files,
                        Messages& messages) {
  const bool is_directory = std::filesystem::is_directory(path);
  const std::string extension = is_directory ? "" : lower_extension(path);
  const std::string format = extension.empty() ? files.format : extension;
  if (files.recenter && format == "nef") {
    throw UnsupportedError("--recenter applies to mesh files; cells in .nef files keep their place");
  }
  const auto thin = std::count_if(cells.begin(), cells.end(), [](const ConvexCell& c) { return c.dimension < 2; });
  if (thin > 0 && format == "ply") {
    messages.push_back(path + ": " + std::to_string(thin) +
                       " of the cells are segments or points, which PLY cannot store");
  }
  const Coordinates coordinates{.exact = files.exact, .offset = files.recenter ? middle_of(cells) : Rational3{}};
  WrittenFile written{.offset = coordinates.offset};
  if (!files.exact && format != "nef") written.problem = problem_of_rounded(path, cells, coordinates.offset);
  if (!written.problem.empty() && !files.lenient) {
    throw UnsupportedError(written.problem + "; --exact writes them exactly, --lenient as they are");
  }
  if (!extension.empty()) {
    write_mesh_file(path, cells, 0, extension, coordinates);
    return written;
  }
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw InputError(path + ": the folder cannot be created (" + error.message() + ")");
  if (const std::string stale = stale_cell(path, cells.size(), format); !stale.empty()) {
    throw InputError(path + ": contains " + stale + " of an earlier run; empty it or name another folder");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string file = cell_path(path, i, format);
    if (format == "nef") {
      write_polyhedron(file, to_polyhedron(cells[i]));
    } else if (format != "ply" || cells[i].dimension >= 2) {
      write_mesh_file(file, cells.subspan(i, 1), i, format, coordinates);
    }
  }
  return written;
}

}  // namespace nef::minkowski
