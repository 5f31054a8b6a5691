// SPDX-License-Identifier: Apache-2.0
//
// Each text format is one function from a mesh to bytes; GLB and 3MF have files of their own. `write_mesh` takes the
// one of the table of formats. Before, it refuses what the format cannot hold: exact or binary numbers, colours, and
// coordinates beyond the range of its numbers.
#include "nef/io/mesh/mesh_writer.h"

#include <cmath>

#include "nef/export/nearest_float.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/number_text.h"
#include "nef/io/text_cursor.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/vertex_merger.h"

namespace nef {
namespace {

void append_coordinate(std::string& text, const Rational& value, bool exact) {
  if (exact) {
    append_integer(text, value.get_num_mpz_t());
    if (value.get_den() == 1) return;
    text += '/';
    append_integer(text, value.get_den_mpz_t());
  } else {
    append_number(text, nearest_double(value));
  }
}

void append_point(std::string& text, const Rational3& point, bool exact) {
  append_coordinate(text, point[0], exact);
  text += ' ';
  append_coordinate(text, point[1], exact);
  text += ' ';
  append_coordinate(text, point[2], exact);
  text += '\n';
}

void append_color(std::string& text, const std::array<std::uint8_t, 3>& color) {
  for (const std::uint8_t x : color) {
    text += ' ';
    append_number(text, std::uint32_t{x});
  }
}

// The outward unit normal of a triangle in doubles, for readers that want one; zero where it can not be told.
Double3 unit_normal(const std::array<Double3, 3>& t) {
  Double3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  for (double& x : n) x /= length;
  return n;
}

// "offset x y z" behind `before`, for comments; nothing if there is no offset.
std::string offset_text(const char* before, const Rational3& offset, const char* after) {
  if (is_zero(offset)) return "";
  std::string text = std::string(before) + "offset";
  for (const Rational& x : offset) {
    text += ' ';
    append_number(text, nearest_double(x));
  }
  return text + after;
}

std::string text_stl(const Mesh& mesh, const MeshSurface& surface, const Rational3& offset) {
  std::vector<std::array<double, 3>> points;
  for (const Rational3& p : mesh.vertices) {
    points.push_back(nearest_doubles(p));
  }
  const auto append = [](std::string& text, const std::array<double, 3>& p) {
    for (const double x : p) {
      text += ' ';
      append_number(text, x);
    }
    text += '\n';
  };
  // Some readers look at byte 80 before they know whether a file is text, so that without facets is not shorter.
  if (surface.triangles.empty()) {
    const std::string name = "solid nef: the empty set, a solid without any facets";
    return name + "\nend" + name + "\n";
  }
  std::string text = "solid nef" + offset_text(" ", offset, "") + "\n";
  for (const auto& t : surface.triangles) {
    text += " facet normal";
    append(text, unit_normal({points[t[0]], points[t[1]], points[t[2]]}));
    text += "  outer loop\n";
    for (const std::uint32_t v : t) {
      text += "   vertex";
      append(text, points[v]);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid nef\n";
}

std::string binary_stl(const Mesh& mesh, const MeshSurface& surface, const Rational3& offset) {
  std::vector<std::array<float, 3>> points;
  for (const Rational3& p : mesh.vertices) {
    points.push_back({nearest_float(p[0]), nearest_float(p[1]), nearest_float(p[2])});
  }
  std::string bytes = "binary STL";  // not "solid", which would look like text
  constexpr std::size_t kHeader = 80;
  const std::string note = offset_text(", ", offset, "");
  if (bytes.size() + note.size() <= kHeader) bytes += note;
  bytes.resize(kHeader, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& t : surface.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) corners[i][axis] = static_cast<double>(points[t[i]][axis]);
    }
    for (const double x : unit_normal(corners)) append_little_endian(bytes, static_cast<float>(x));
    for (const std::uint32_t v : t) {
      for (const float x : points[v]) append_little_endian(bytes, x);
    }
    append_little_endian(bytes, std::uint16_t{0});
  }
  return bytes;
}

[[noreturn]] void refuse_format(const std::string& path, const std::string& what) {
  throw FileError(FileProblem::kUnreadable, path + ": " + what);
}

}  // namespace

std::string off_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  std::string text = "OFF\n";
  text += std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.face_count()) + " 0\n";
  for (const Rational3& p : mesh.vertices) append_point(text, p, options.exact);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    append_number(text, mesh.face(f).size());
    for (const std::uint32_t v : mesh.face(f)) {
      text += ' ';
      append_number(text, v);
    }
    if (!options.groups.none()) append_color(text, group_color(options.groups.of_face[f]));
    text += '\n';
  }
  return text + offset_text("# ", options.offset, "\n");
}

std::string obj_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  std::string text =
      "# " + std::to_string(mesh.vertices.size()) + " vertices, " + std::to_string(mesh.face_count()) + " faces\n";
  text += offset_text("# ", options.offset, "\n");
  for (const Rational3& p : mesh.vertices) {
    text += "v ";
    append_point(text, p, options.exact);
  }
  const auto append_face = [&](std::size_t f) {
    text += 'f';
    for (const std::uint32_t v : mesh.face(f)) {
      text += ' ';
      append_number(text, v + 1);
    }
    text += '\n';
  };
  if (options.groups.none()) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) append_face(f);
  }
  const std::vector<std::vector<std::uint32_t>> groups = faces_by_group(options.groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    text += "g " + group_word(options.groups.names[g]) + "\n";
    for (const std::uint32_t f : groups[g]) append_face(f);
  }
  for (const auto& line : options.lines) {
    text += "l " + std::to_string(line[0] + 1) + " " + std::to_string(line[1] + 1) + "\n";
  }
  for (const std::uint32_t v : options.points) text += "p " + std::to_string(v + 1) + "\n";
  return text;
}

std::string stl_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  const MeshSurface surface(mesh, options.monitor);
  return options.binary ? binary_stl(mesh, surface, options.offset) : text_stl(mesh, surface, options.offset);
}

std::string ply_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  std::string bytes = "ply\nformat ";
  bytes += options.binary ? "binary_little_endian" : "ascii";
  bytes += " 1.0\n" + offset_text("comment ", options.offset, "\n");
  const FaceGroups& groups = options.groups;
  for (std::size_t g = 0; g < groups.names.size(); ++g) {
    bytes += "comment group " + std::to_string(g) + " " + group_word(groups.names[g]) + "\n";
  }
  bytes += "element vertex " + std::to_string(mesh.vertices.size());
  bytes += "\nproperty double x\nproperty double y\nproperty double z\n";
  const bool colored = !options.vertex_colors.empty();
  if (colored) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += "element face " + std::to_string(mesh.face_count()) + "\nproperty list int int vertex_indices\n";
  if (!groups.none()) {
    bytes += "property int group\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  bytes += "end_header\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Rational3& p = mesh.vertices[v];
    if (options.binary) {
      for (const Rational& x : p) append_little_endian(bytes, nearest_double(x));
      if (colored) {
        for (const std::uint8_t x : options.vertex_colors[v]) append_little_endian(bytes, x);
      }
      continue;
    }
    append_point(bytes, p, options.exact);
    if (!colored) continue;
    bytes.pop_back();  // the end of the line
    append_color(bytes, options.vertex_colors[v]);
    bytes += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (options.binary) {
      append_little_endian(bytes, static_cast<std::uint32_t>(face.size()));
      for (const std::uint32_t v : face) append_little_endian(bytes, v);
      if (!groups.none()) {
        append_little_endian(bytes, groups.of_face[f]);
        for (const std::uint8_t x : group_color(groups.of_face[f])) append_little_endian(bytes, x);
      }
      continue;
    }
    append_number(bytes, face.size());
    for (const std::uint32_t v : face) {
      bytes += ' ';
      append_number(bytes, v);
    }
    if (!groups.none()) {
      bytes += ' ';
      append_number(bytes, groups.of_face[f]);
      append_color(bytes, group_color(groups.of_face[f]));
    }
    bytes += '\n';
  }
  return bytes;
}

void refuse_infinite(const Mesh& mesh, const MeshFormat& format, const MeshWriteOptions& options) {
  if (options.exact) return;
  const bool single = format.numbers(options.binary) == FileNumbers::kFloats;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const Rational& x : mesh.vertices[v]) {
      if (std::isfinite(single ? static_cast<double>(nearest_float(x)) : nearest_double(x))) continue;
      throw FileError(FileProblem::kUnsupported,
                      "a coordinate of vertex " + std::to_string(v) + " of the mesh is beyond " +
                          (single ? std::string("single precision (3.4e38); write text or .nef, or scale the set")
                                  : "doubles (1.8e308); write it with --exact to " + mesh_format_names(kFractions) +
                                        ", or write .nef"),
                      FileElement::vertex(v));
    }
  }
}

std::string merged_vertices(const Mesh& mesh, bool single) {
  std::vector<Rational3> rounded;
  rounded.reserve(mesh.vertices.size());
  for (const Rational3& p : mesh.vertices) {
    Rational3& q = rounded.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = single ? static_cast<double>(nearest_float(p[axis])) : nearest_double(p[axis]);
      q[axis] = x;
    }
  }
  const std::vector<std::uint32_t> exact_place = merge_equal(mesh.vertices);
  const std::vector<std::uint32_t> place = merge_equal(rounded);
  std::size_t merged = 0;
  for (std::size_t v = 0; v < place.size(); ++v) merged += place[v] != exact_place[v] ? 1 : 0;
  if (merged == 0) return "";
  return std::to_string(merged) + (merged == 1 ? " vertex lies" : " vertices lie") +
         " where another one does after rounding to " + (single ? "single" : "double") + " precision";
}

void write_mesh(const std::string& path, const Mesh& mesh, const MeshWriteOptions& options) {
  const MeshFormat& format = mesh_format_of(path, options.format);
  if (options.exact && (options.binary || !format.has(kFractions))) {
    refuse_format(path, "exact coordinates need " + mesh_format_names(kFractions) + ", as text");
  }
  if (options.binary && !format.has_two_forms()) {
    const auto has_two = [](const MeshFormat& other) { return other.has_two_forms(); };
    refuse_format(path, "only " + mesh_format_names(has_two, "and") + " can be binary");
  }
  if (!options.vertex_colors.empty() && !format.has(kVertexColors)) {
    refuse_format(path, "the format has no colours of vertices; write " + mesh_format_names(kVertexColors));
  }
  refuse_infinite(mesh, format, options);
  write_file(path, format.write(mesh, options));
}

}  // namespace nef
