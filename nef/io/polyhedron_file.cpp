// SPDX-License-Identifier: Apache-2.0
//
// Reading: mesh formats are known by the extension, the others also by their first words. Writing a mesh format:
// `to_mesh` exports the boundary, `BoundaryWriter` settles it (recenter, round and repair, separate touching sheets),
// and `write_mesh` makes the bytes. Each step adds what it changed or lost to the messages.
#include "nef/io/polyhedron_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "nef/base/counted.h"
#include "nef/base/freed_memory.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/io/output_path.h"
#include "nef/mesh/recenter.h"
#include "nef/mesh/separate_sheets.h"
#include "nef/polyhedron.h"

namespace nef {

namespace {

// A format that holds sets as they are.
struct SetFormat {
  std::string_view extension;
  bool (*recognizes)(std::string_view bytes);
  Polyhedron (*read)(std::string_view bytes, const std::string& path, const Monitor& monitor);
  std::string (*write)(const Polyhedron& set, bool text, Messages* messages);
};

constexpr std::array kSetFormats{
    SetFormat{"nef", [](std::string_view bytes) { return bytes.starts_with("nef ") || is_native_binary(bytes); },
              read_native,
              [](const Polyhedron& set, bool text, Messages* /*messages*/) {
                return text ? native_text(set) : native_binary(set);
              }},
    SetFormat{"nef3", [](std::string_view bytes) { return bytes.starts_with("Selective Nef Complex"); }, read_nef3,
              [](const Polyhedron& set, bool /*text*/, Messages* messages) { return nef3_text(set, messages); }},
};

const SetFormat* find_set_format(std::string_view extension) {
  const auto found = std::find_if(kSetFormats.begin(), kSetFormats.end(),
                                  [&](const SetFormat& format) { return format.extension == extension; });
  return found == kSetFormats.end() ? nullptr : &*found;
}

void report_wires(const MeshExport& result, Messages& notes) {
  const auto add = [&notes](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    notes.push_back(counted(count, one, many) + " not in the file, because the format stores faces only; write " +
                    mesh_format_names(kWires) + " or .nef");
  };
  add(result.lines.size(), "line is", "lines are");
  add(result.points.size(), "point is", "points are");
}

// The mesh of one file on its way from exact coordinates to those that are written.
class BoundaryWriter {
 public:
  BoundaryWriter(std::string path, const PolyhedronWriteOptions& options, Messages& notes)
      : path_(std::move(path)), format_(mesh_format_of(path_, options.format)), options_(options), notes_(notes) {
    file_.exact = options.exact;
    file_.binary = options.binary;
    file_.format = format_.extension;
    file_.monitor = options.monitor;
    const FileNumbers numbers = format_.numbers(options.binary);
    single_ = numbers == FileNumbers::kFloats;
    rounding_ = rounding_to(numbers);
  }

  /// What the options for the bytes say so far.
  [[nodiscard]] MeshWriteOptions& file() { return file_; }
  [[nodiscard]] const MeshFormat& format() const { return format_; }
  [[nodiscard]] const Rounding& rounding() const { return rounding_; }

  /// Moves the mesh to the origin.
  void recenter(Mesh& mesh) { file_.offset = nef::recenter(mesh); }

  /// Rounds, repairs and separates the closed surface of a solid. Throws where that is impossible, unless lenient.
  void settle(Mesh& mesh, bool is_strict) {
    if (options_.manifold && !format_.has(kNamedVertices)) {
      throw UnsupportedError(std::string(format_.name) +
                             " stores no shared vertices, so sheets that touch cannot be separated in it; write " +
                             mesh_format_names(kNamedVertices));
    }
    if (options_.manifold && !file_.groups.none()) {
      throw UnsupportedError("--manifold cuts faces, so they cannot keep groups; remove one of the two options");
    }
    std::string problem;
    if (!is_strict && options_.exact) {
      problem = strict_problem(mesh, options_.monitor);
    } else if (!options_.exact && !(is_strict && are_kept(mesh, rounding_))) {
      problem = round(mesh);
    }
    if (problem.empty() && options_.manifold) problem = separate(mesh);
    if (problem.empty()) return;
    const std::string how = options_.exact
                                ? "the mesh"
                                : "rounded to " + std::string(single_ ? "single" : "double") + " precision, the mesh";
    written_.problem = path_ + ": " + how + " is not valid (" + problem + ")";
    refuse_unless_lenient(" and could not be repaired");
    const std::string merged = options_.exact ? "" : merged_vertices(mesh, single_);
    if (!merged.empty()) notes_.push_back(merged);
  }

  /// Throws where vertices of a surface, of lines or of points become one by rounding, unless lenient.
  void require_apart(const Mesh& mesh) {
    if (options_.exact) return;
    refuse_infinite(mesh, format_, file_);
    const std::string merged = merged_vertices(mesh, single_);
    if (merged.empty()) return;
    written_.problem = path_ + ": " + merged;
    refuse_unless_lenient("");
  }

  /// Gives the vertices the colours, or the faces the texture, that the options have for them.
  void color(const Mesh& mesh) {
    if (!options_.vertex_colors && !options_.texture) return;
    Mesh in_place = mesh;
    for (Rational3& p : in_place.vertices) {
      for (std::size_t i = 0; i < 3; ++i) p[i] += file_.offset[i];
    }
    if (options_.vertex_colors) file_.vertex_colors = options_.vertex_colors(in_place);
    if (options_.texture && mesh.face_count() > 0) file_.texture = options_.texture(in_place);
  }

  WrittenFile write(const Mesh& mesh) {
    write_mesh(path_, mesh, file_);
    written_.offset = file_.offset;
    return written_;
  }

 private:
  void refuse_unless_lenient(const std::string& more) const {
    if (options_.lenient) return;
    throw UnsupportedError(written_.problem + more + ", so no file was written; write .nef, or " +
                           mesh_format_names(kFractions) +
                           " with --exact, or move it to the origin (--recenter); --lenient writes it as it is");
  }

  // Replaces the mesh by one of the numbers that are written, and returns why there is none.
  std::string round(Mesh& mesh) {
    refuse_infinite(mesh, format_, file_);
    MendedMesh rounded = round_mesh(mesh, rounding_, options_.monitor);
    if (!rounded.legal) return rounded.problem;
    if (const std::string done = repair_text(rounded); !done.empty()) notes_.push_back(done);
    mesh = std::move(rounded.mesh);
    if (file_.groups.none() || rounded.face_of.empty()) return "";
    std::vector<std::uint32_t> groups;
    for (const std::uint32_t face : rounded.face_of) groups.push_back(file_.groups.of_face[face]);
    file_.groups.of_face = std::move(groups);
    return "";
  }

  // The middles of edges that this adds are rounded with the file, so they are checked.
  std::string separate(Mesh& mesh) {
    SeparatedSheets separated = separate_sheets(mesh);
    mesh = std::move(separated.mesh);
    if (separated.copies == 0) return "";
    notes_.push_back("the solid touches itself, in " + std::to_string(separated.edges) +
                     " edges: " + std::to_string(separated.copies) + " vertices are duplicated in the file");
    if (options_.exact || are_kept(mesh, rounding_)) return "";
    return rounded_problem(mesh, rounding_, options_.monitor);
  }

  std::string path_;
  const MeshFormat& format_;
  const PolyhedronWriteOptions& options_;
  Messages& notes_;
  MeshWriteOptions file_;
  Rounding rounding_;
  bool single_ = false;
  WrittenFile written_;
};

// The faces' groups, numbered by name.
FaceGroups groups_of(const MeshExport& result, const BoundaryGroups& groups) {
  std::map<std::array<LabelId, 3>, std::string> name;
  for (const auto& marks : result.face_marks) {
    if (!name.contains(marks)) name.emplace(marks, groups.name(marks[0], marks[1], marks[2]));
  }
  std::map<std::string, std::uint32_t> number;
  for (const auto& [marks, text] : name) number.emplace(text, 0);
  FaceGroups out;
  for (auto& [text, index] : number) {
    index = static_cast<std::uint32_t>(out.names.size());
    out.names.push_back(text);
  }
  for (const auto& marks : result.face_marks) out.of_face.push_back(number.at(name.at(marks)));
  return out;
}

struct WrittenBoundary {
  WrittenFile file;
  FaceGroups groups;  // as written
};

MeshExport exported(const Polyhedron& polyhedron, const PolyhedronWriteOptions& options, const BoundaryGroups* groups,
                    BoundaryWriter& writer) {
  MeshExportOptions export_options;
  export_options.keep_polygons = writer.format().has(kPolygons) && !options.texture;
  export_options.only_quads = !options.polygons;
  export_options.lower_dimensional = true;
  // Where the mesh is moved, its polygons stay planar only if all else of it is written as it is, too.
  if (options.recenter) export_options.keep_polygons = export_options.keep_polygons && options.exact;
  export_options.polygon_corner = [&](const Rational3& point) {
    return options.exact || is_kept(point, writer.rounding(), Readers::kOurs);
  };
  if (groups != nullptr) {
    export_options.selected = groups->selected;
    export_options.face_marks = true;
  }
  return to_mesh(polyhedron, export_options, options.monitor);
}

// Writes a mesh format.
WrittenBoundary write_boundary(const std::string& path, const Polyhedron& polyhedron,
                               const PolyhedronWriteOptions& options, const BoundaryGroups* groups,
                               Messages* messages) {
  Messages notes;
  BoundaryWriter writer(path, options, notes);
  MeshExport result = exported(polyhedron, options, groups, writer);
  notes = result.lost;
  MeshWriteOptions& file = writer.file();
  if (groups != nullptr) file.groups = groups_of(result, *groups);
  if (writer.format().has(kWires)) {
    file.lines = result.lines;
    file.points = result.points;
  } else {
    report_wires(result, notes);
  }
  if (options.recenter) writer.recenter(result.mesh);
  if (result.closed) {
    writer.settle(result.mesh, true);
  } else {
    writer.require_apart(result.mesh);
  }
  writer.color(result.mesh);
  if (groups != nullptr && !writer.format().has(kFaceGroups)) {
    notes.push_back("groups of faces are not in the file, because the format has none; write " +
                    mesh_format_names(kFaceGroups));
  }
  WrittenBoundary written;
  written.file = writer.write(result.mesh);
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  written.groups = std::move(file.groups);
  return written;
}

// The bytes go once they are read.
Mesh mesh_of(std::string&& bytes, const std::string& path, MeshParts* parts) {
  const std::string taken = std::move(bytes);
  return read_mesh(taken, path, parts);
}

Polyhedron set_of_mesh_file(std::string&& bytes, const PartPath& at, const std::string& path,
                            const MeshOptions& options, Messages* messages) {
  MeshParts parts;
  Mesh mesh = mesh_of(std::move(bytes), at.file, at.part.empty() ? nullptr : &parts);
  if (!at.part.empty()) mesh = faces_of_part(mesh, parts, at);
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

// What only meshes can have is refused where it would do nothing.
void require_no_mesh_options(const std::string& path, const PolyhedronWriteOptions& options) {
  if (!options.manifold && !options.recenter) return;
  throw UnsupportedError(path + ": " + (options.manifold ? "--manifold" : "--recenter") +
                         " applies to meshes, and this format stores the set as it is; write " +
                         mesh_format_names(kNamedVertices));
}

}  // namespace

Polyhedron read_polyhedron(const std::string& path, const MeshOptions& options, Messages* messages) {
  const PartPath at = part_path(path);
  const std::string extension = lower_extension(at.file);
  std::string bytes = read_file(at.file);  // once: it may be a pipe
  if (find_mesh_format(extension) == nullptr && at.part.empty()) {
    for (const SetFormat& format : kSetFormats) {
      if (format.recognizes(bytes)) return format.read(bytes, path, options.monitor);
    }
    if (const SetFormat* named = find_set_format(extension)) return named->read(bytes, path, options.monitor);
  }
  constexpr std::size_t kLarge = std::size_t{1} << 22U;  // smaller ones leave little behind
  const bool is_large = bytes.size() > kLarge;
  Polyhedron set = set_of_mesh_file(std::move(bytes), at, path, options, messages);
  if (is_large) return_freed_memory();
  return set;
}

bool is_set_extension(std::string_view extension) { return find_set_format(extension) != nullptr; }

bool is_file_extension(std::string_view extension) {
  return is_set_extension(extension) || find_mesh_format(extension) != nullptr;
}

std::vector<std::string> file_extensions() {
  std::vector<std::string> all;
  for (const SetFormat& format : kSetFormats) all.emplace_back(format.extension);
  for (const MeshFormat& format : mesh_formats()) all.emplace_back(format.extension);
  return all;
}

std::string offset_note(const std::string& path, const Rational3& offset) {
  std::string text = "the mesh in " + path + " was moved near the origin; subtracted from its coordinates:";
  for (const Rational& x : offset) text += " " + x.get_str();
  return text;
}

WrittenFile write_polyhedron(const std::string& path, const Polyhedron& polyhedron,
                             const PolyhedronWriteOptions& options, Messages* messages) {
  const std::string extension = options.format.empty() ? lower_extension(path) : options.format;
  if (const SetFormat* format = find_set_format(extension)) {
    require_no_mesh_options(path, options);
    write_file(path, format->write(polyhedron, options.text, messages));
    return {};
  }
  if (find_mesh_format(extension) == nullptr) throw unknown_extension(path);
  return write_boundary(path, polyhedron, options, nullptr, messages).file;
}

WrittenFile write_solid_mesh(const std::string& path, Mesh mesh, bool is_strict, const PolyhedronWriteOptions& options,
                             Messages* messages) {
  Messages notes;
  BoundaryWriter writer(path, options, notes);
  if (options.recenter) writer.recenter(mesh);
  if (mesh.face_count() > 0) writer.settle(mesh, is_strict);
  writer.color(mesh);
  WrittenFile written = writer.write(mesh);
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return written;
}

std::map<std::string, std::size_t> write_groups(const std::string& path, const Polyhedron& labeled,
                                                const BoundaryGroups& groups, const PolyhedronWriteOptions& options,
                                                Messages* messages, WrittenFile* written) {
  if (find_mesh_format(options.format.empty() ? lower_extension(path) : options.format) == nullptr) {
    throw FileError(FileProblem::kUnreadable,
                    path + ": groups of faces need a mesh format: " + mesh_format_names(kFaceGroups));
  }
  const WrittenBoundary boundary = write_boundary(path, labeled, options, &groups, messages);
  if (written != nullptr) *written = boundary.file;
  std::map<std::string, std::size_t> count;
  for (const std::string& name : boundary.groups.names) count.emplace(name, 0);
  for (const std::uint32_t group : boundary.groups.of_face) ++count.at(boundary.groups.names[group]);
  return count;
}

}  // namespace nef
