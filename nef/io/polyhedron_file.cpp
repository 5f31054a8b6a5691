// SPDX-License-Identifier: Apache-2.0
#include "nef/io/polyhedron_file.h"

#include <algorithm>
#include <array>
#include <map>

#include "nef/base/freed_memory.h"
#include "nef/export/to_mesh.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/native/native_binary.h"
#include "nef/io/native/native_format.h"
#include "nef/io/number_text.h"
#include "nef/mesh/separate_sheets.h"
#include "nef/polyhedron.h"

namespace nef {

namespace {

void report_wires(const MeshExport& result, Messages& notes) {
  const auto add = [&notes](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    notes.push_back(std::to_string(count) + " " + (count == 1 ? one : many) +
                    " not in the mesh: faces are all that the format has; write OBJ or .nef");
  };
  add(result.lines.size(), "line is", "lines are");
  add(result.points.size(), "point is", "points are");
}

std::string mending_text(const MendedMesh& rounded) {
  std::string text = "rounding made the mesh cross itself; it was mended:";
  if (rounded.moved > 0) text += " " + std::to_string(rounded.moved) + " vertices went to other numbers nearby";
  if (rounded.moved > 0 && rounded.dropped > 0) text += ",";
  if (rounded.dropped > 0) text += " " + std::to_string(rounded.dropped) + " slivers were dropped";
  text += " (off by at most ";
  append_number(text, rounded.largest_move);
  return text + "); --exact or .nef keep everything";
}

// Replaces a mesh whose rounding is not legal by one that is, or tells that this can't be done.
void round_and_mend(Mesh& mesh, const std::string& extension, unsigned threads, MeshWriteOptions& options,
                    Messages& notes) {
  const auto survives = [&](const Rational3& p) { return survives_writing(p, extension, options); };
  if (std::all_of(mesh.vertices.begin(), mesh.vertices.end(), survives)) return;
  refuse_infinite(mesh, extension, options);
  const bool single = is_single_precision(extension, options);
  const Rounding rounding = single           ? rounding_to_binary_floats()
                            : options.binary ? rounding_to_binary_doubles()
                                             : rounding_to_decimals();
  MendedMesh rounded = round_mesh(mesh, rounding, threads, options.monitor);
  if (!rounded.legal) {
    notes.push_back("rounded to " + std::string(single ? "single" : "double") +
                    " precision the mesh is no border of a solid any more, and could not be mended (" +
                    rounded.problem + "); write it with --exact to OFF, OBJ or PLY, or write .nef");
    return;
  }
  if (rounded.moved > 0 || rounded.dropped > 0) notes.push_back(mending_text(rounded));
  mesh = std::move(rounded.mesh);
  if (options.groups.none() || rounded.face_of.empty()) return;
  std::vector<std::uint32_t> groups;
  for (const std::uint32_t face : rounded.face_of) groups.push_back(options.groups.of_face[face]);
  options.groups.of_face = std::move(groups);
}

void separate(Mesh& mesh, const std::string& extension, Messages& notes) {
  if (extension == "stl") {
    throw UnsupportedError(
        "STL names no vertices, so sheets that touch can not be told apart in it; write OFF, OBJ, PLY, GLB or 3MF");
  }
  SeparatedSheets separated = separate_sheets(mesh);
  mesh = std::move(separated.mesh);
  if (separated.copies == 0) return;
  notes.push_back("the solid touches itself, in " + std::to_string(separated.edges) +
                  " edges: " + std::to_string(separated.copies) + " vertices are in the file once more");
}

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

// Writes a mesh format. Returns the groups as written.
FaceGroups write_boundary(const std::string& path, const std::string& extension, const Polyhedron& polyhedron,
                          const PolyhedronWriteOptions& options, const BoundaryGroups* groups, Messages* messages) {
  MeshExportOptions export_options;
  export_options.keep_polygons = extension != "stl" && extension != "glb" && extension != "3mf";
  export_options.only_convex = !options.polygons;
  export_options.lower_dimensional = true;
  MeshWriteOptions write_options{
      .exact = options.exact, .binary = options.binary, .format = extension, .monitor = options.monitor};
  export_options.polygon_corner = [&](const Rational3& point) {
    return survives_writing(point, extension, write_options);
  };
  if (groups != nullptr) {
    export_options.selected = groups->selected;
    export_options.face_marks = true;
  }
  MeshExport result = to_mesh(polyhedron, export_options, options.monitor);
  Messages notes = result.lost;
  if (groups != nullptr) write_options.groups = groups_of(result, *groups);
  if (extension == "obj") {
    write_options.lines = result.lines;
    write_options.points = result.points;
  } else {
    report_wires(result, notes);
  }
  if (result.closed && options.check) round_and_mend(result.mesh, extension, options.threads, write_options, notes);
  if (options.manifold && result.closed && groups == nullptr) separate(result.mesh, extension, notes);
  if (options.vertex_colors) write_options.vertex_colors = options.vertex_colors(result.mesh);
  if (groups != nullptr && !has_groups(extension)) {
    notes.push_back("groups of faces are not in the file: the format has none; write OBJ, OFF, PLY or GLB");
  }
  write_mesh(path, result.mesh, write_options, &notes);
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return std::move(write_options.groups);
}

// The bytes go once they are read.
Mesh mesh_of(std::string&& bytes, const std::string& path) {
  const std::string taken = std::move(bytes);
  return read_mesh(taken, path);
}

Polyhedron set_of_mesh_file(std::string&& bytes, const std::string& path, const MeshOptions& options,
                            Messages* messages) {
  const Mesh mesh = mesh_of(std::move(bytes), path);
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace

Polyhedron read_polyhedron(const std::string& path, const MeshOptions& options, Messages* messages) {
  const std::string extension = lower_extension(path);
  std::string bytes = read_file(path);  // once: it may be a pipe
  if (!is_mesh_extension(extension)) {
    // Files without a telling extension are known by their first word.
    if (extension == "nef3" || bytes.starts_with("Selective Nef Complex")) {
      return read_nef3(bytes, path, options.monitor);
    }
    if (extension == "nef" || bytes.starts_with("nef ") || is_native_binary(bytes)) {
      return read_native(bytes, path, options.monitor);
    }
  }
  constexpr std::size_t kLarge = std::size_t{1} << 22U;  // smaller ones leave little behind
  const bool is_large = bytes.size() > kLarge;
  Polyhedron set = set_of_mesh_file(std::move(bytes), path, options, messages);
  if (is_large) return_freed_memory();
  return set;
}

void write_polyhedron(const std::string& path, const Polyhedron& polyhedron, const PolyhedronWriteOptions& options,
                      Messages* messages) {
  const std::string extension = options.format.empty() ? lower_extension(path) : options.format;
  if (extension == "nef") {
    write_file(path, options.text ? native_text(polyhedron) : native_binary(polyhedron));
    return;
  }
  if (extension == "nef3") {
    write_file(path, nef3_text(polyhedron, messages));
    return;
  }
  if (!is_mesh_extension(extension)) {
    throw FileError(FileProblem::kUnreadable,
                    path + ": the extension names no format; use nef, nef3, off, obj, stl, ply, glb or 3mf");
  }
  write_boundary(path, extension, polyhedron, options, nullptr, messages);
}

std::map<std::string, std::size_t> write_groups(const std::string& path, const Polyhedron& labeled,
                                                const BoundaryGroups& groups, const PolyhedronWriteOptions& options,
                                                Messages* messages) {
  const std::string extension = options.format.empty() ? lower_extension(path) : options.format;
  if (!is_mesh_extension(extension)) {
    throw FileError(FileProblem::kUnreadable, path + ": groups of faces need a mesh format: off, obj, ply or glb");
  }
  const FaceGroups written = write_boundary(path, extension, labeled, options, &groups, messages);
  std::map<std::string, std::size_t> count;
  for (const std::string& name : written.names) count.emplace(name, 0);
  for (const std::uint32_t group : written.of_face) ++count.at(written.names[group]);
  return count;
}

}  // namespace nef
