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

// The places of the corners in the image, and the material that names it; nothing without a texture.
TexturedVertices obj_texture(std::string& text, const Mesh& mesh, const MeshTexture& texture) {
  if (texture.none()) return {};
  TexturedVertices textured = textured_vertices(mesh, texture);
  for (const auto& place : textured.places) {
    text += "vt ";
    append_number(text, place[0]);
    text += ' ';
    append_number(text, place[1]);
    text += '\n';
  }
  text += "usemtl texture\n";
  return textured;
}

// The parts of a PLY file. With a texture its vertices are those of textured_vertices.
class PlyWriter {
 public:
  PlyWriter(const Mesh& mesh, const MeshWriteOptions& options)
      : mesh_(mesh), options_(options), colored_(!options.vertex_colors.empty()), textured_(!options.texture.none()) {
    if (textured_) vertices_ = textured_vertices(mesh, options.texture);
  }

  [[nodiscard]] std::string header() const {
    std::string text = "ply\nformat ";
    text += options_.binary ? "binary_little_endian" : "ascii";
    text += " 1.0\n" + offset_text("comment ", options_.offset, "\n");
    const FaceGroups& groups = options_.groups;
    for (std::size_t g = 0; g < groups.names.size(); ++g) {
      text += "comment group " + std::to_string(g) + " " + group_word(groups.names[g]) + "\n";
    }
    if (textured_) text += "comment TextureFile " + image_file_name(options_.texture.stem) + "\n";
    text += "element vertex " + std::to_string(vertex_count());
    text += "\nproperty double x\nproperty double y\nproperty double z\n";
    if (colored_) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (textured_) text += "property float texture_u\nproperty float texture_v\n";
    text += "element face " + std::to_string(mesh_.face_count()) + "\nproperty list int int vertex_indices\n";
    if (!groups.none()) {
      text += "property int group\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    return text + "end_header\n";
  }

  void append_vertices(std::string& bytes) const {
    for (std::size_t i = 0; i < vertex_count(); ++i) {
      const std::size_t v = textured_ ? vertices_.vertex[i] : i;
      options_.binary ? append_binary_vertex(bytes, i, v) : append_text_vertex(bytes, i, v);
    }
  }

  void append_faces(std::string& bytes) const {
    const std::vector<std::uint32_t>& corners = textured_ ? vertices_.corners : mesh_.corners;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = std::span(corners).subspan(mesh_.face_begin[f], mesh_.face(f).size());
      options_.binary ? append_binary_face(bytes, f, face) : append_text_face(bytes, f, face);
    }
  }

 private:
  [[nodiscard]] std::size_t vertex_count() const { return textured_ ? vertices_.vertex.size() : mesh_.vertices.size(); }

  void append_binary_vertex(std::string& bytes, std::size_t i, std::size_t v) const {
    for (const Rational& x : mesh_.vertices[v]) append_little_endian(bytes, nearest_double(x));
    if (colored_) {
      for (const std::uint8_t x : options_.vertex_colors[v]) append_little_endian(bytes, x);
    }
    if (textured_) {
      for (const float x : vertices_.places[i]) append_little_endian(bytes, x);
    }
  }

  void append_text_vertex(std::string& text, std::size_t i, std::size_t v) const {
    append_point(text, mesh_.vertices[v], options_.exact);
    text.pop_back();  // the end of the line
    if (colored_) append_color(text, options_.vertex_colors[v]);
    if (textured_) {
      for (const float x : vertices_.places[i]) {
        text += ' ';
        append_number(text, x);
      }
    }
    text += '\n';
  }

  void append_binary_face(std::string& bytes, std::size_t f, std::span<const std::uint32_t> face) const {
    append_little_endian(bytes, static_cast<std::uint32_t>(face.size()));
    for (const std::uint32_t v : face) append_little_endian(bytes, v);
    if (options_.groups.none()) return;
    append_little_endian(bytes, options_.groups.of_face[f]);
    for (const std::uint8_t x : group_color(options_.groups.of_face[f])) append_little_endian(bytes, x);
  }

  void append_text_face(std::string& text, std::size_t f, std::span<const std::uint32_t> face) const {
    append_number(text, face.size());
    for (const std::uint32_t v : face) {
      text += ' ';
      append_number(text, v);
    }
    if (!options_.groups.none()) {
      text += ' ';
      append_number(text, options_.groups.of_face[f]);
      append_color(text, group_color(options_.groups.of_face[f]));
    }
    text += '\n';
  }

  const Mesh& mesh_;
  const MeshWriteOptions& options_;
  bool colored_;
  bool textured_;
  TexturedVertices vertices_;
};

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
  if (!options.texture.none()) text += "mtllib " + material_file_name(options.texture.stem) + "\n";
  for (const Rational3& p : mesh.vertices) {
    text += "v ";
    append_point(text, p, options.exact);
  }
  const TexturedVertices textured = obj_texture(text, mesh, options.texture);
  const auto append_face = [&](std::size_t f) {
    text += 'f';
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      text += ' ';
      append_number(text, mesh.corners[c] + 1);
      if (options.texture.none()) continue;
      text += '/';
      append_number(text, textured.corners[c] + 1);
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
  const PlyWriter writer(mesh, options);
  std::string bytes = writer.header();
  writer.append_vertices(bytes);
  writer.append_faces(bytes);
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
  if (options.texture.none()) return write_file(path, format.write(mesh, options));
  if (!options.vertex_colors.empty() || !options.groups.none()) {
    refuse_format(path, "a texture excludes colours of vertices and groups of faces");
  }
  const std::string extension(format.extension);
  require_texture(path, mesh, options.texture, extension);
  MeshWriteOptions named = options;
  named.texture.stem = texture_stem(path);
  write_texture_files(path, options.texture, extension);
  write_file(path, format.write(mesh, named));
}

}  // namespace nef
