// SPDX-License-Identifier: Apache-2.0
//
// Polyhedra from and to files of every format, chosen by extension.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/forward.h"
#include "nef/geometry/ids.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef {

/// Reads a polyhedron: .nef (the own format), .nef3 (CGAL's text), or a mesh (see mesh_formats.h) that
/// from_mesh makes a solid of. `messages` gets what was done to the input. Throws InputError (FileError for the file
/// itself) with the path in front of the text.
Polyhedron read_polyhedron(const std::string& path, const MeshOptions& options = {}, Messages* messages = nullptr);

/// All extensions that are read and written: nef and nef3, which store sets as they are, and those of meshes.
std::vector<std::string> file_extensions();
/// True for one of these.
bool is_file_extension(std::string_view extension);
/// True for nef and nef3.
bool is_set_extension(std::string_view extension);

struct PolyhedronWriteOptions {
  bool exact = false;     ///< exact coordinates in mesh files whose format has them
  bool binary = false;    ///< binary instead of text in mesh files whose format has both
  bool text = false;      ///< .nef as text; it is binary otherwise
  bool polygons = false;  ///< faces of more than four corners, or not convex, stay polygons where the format has them
  bool manifold = false;  ///< in mesh files each edge has two faces (separate_sheets; not in STL, and
                          ///< not together with groups)
  bool lenient = false;   ///< write a mesh even if it is known not to be strictly legal
  bool recenter = false;  ///< subtract middle_of_few_digits from the coordinates, so that few digits are lost
  /// Red, green and blue for the vertices of the mesh that goes to a file; PLY, GLB and 3MF only.
  std::function<std::vector<std::array<std::uint8_t, 3>>(const Mesh&)> vertex_colors = {};
  /// The texture of the mesh that goes to a file, which then has triangles only; not in OFF and STL.
  std::function<MeshTexture(const Mesh&)> texture = {};
  std::string format = {};  ///< instead of the extension of the path, which may be none
  Monitor monitor = {};     ///< cancellation, progress, counters; its referents must outlive the call
};

/// Properties of a file that was written.
struct WrittenFile {
  /// Why its mesh is not strictly legal (is_strictly_legal); empty if it is, or the format is not one of meshes. Only
  /// if the options are lenient.
  std::string problem = {};
  /// What was subtracted from all coordinates; zero unless the options say to recenter. GLB and 3MF put it back when
  /// they are read, other formats note it in a comment.
  Rational3 offset = {};
};

/// A note that the coordinates in a file are not those of the set.
std::string offset_note(const std::string& path, const Rational3& offset);

/// Writes a polyhedron to a temporary file, renamed on success. "-" is standard output. Mesh formats store the boundary
/// of the bounded solid parts: convex faces of four corners as they are where rounding leaves them planar, all others
/// as triangles. Coordinates are rounded to the nearest numbers of the format; if the result is not strictly legal
/// (is_strictly_legal) it is repaired by going to other numbers nearby. Sets without solid parts are written as
/// surfaces, and to OBJ as lines and points, if their vertices stay apart. `messages` gets a line for what was repaired
/// and for everything that the file cannot store. Throws FileError for an unknown extension or a file that cannot be
/// written, and UnsupportedError for an unbounded set in .nef3 or a mesh that cannot be repaired, unless the options
/// are lenient; then no file is written.
WrittenFile write_polyhedron(const std::string& path, const Polyhedron& polyhedron,
                             const PolyhedronWriteOptions& options = {}, Messages* messages = nullptr);

/// Writes the closed surface of a solid to a mesh format, as write_polyhedron writes that of a set. `is_strict`: the
/// mesh is strictly legal as it is, so only what rounding does is checked.
WrittenFile write_solid_mesh(const std::string& path, Mesh mesh, bool is_strict,
                             const PolyhedronWriteOptions& options = {}, Messages* messages = nullptr);

/// How the faces of a set with labels are put into groups.
struct BoundaryGroups {
  /// Which marks belong to the set.
  std::function<bool(LabelId)> selected;
  /// The name of the group of a face between volumes of these marks, in a facet of that one.
  std::function<std::string(LabelId inside, LabelId outside, LabelId facet)> name;
};

/// Writes the points with selected marks like write_polyhedron, to a mesh format, and the group that each face
/// belongs to (see MeshWriteOptions; a message where the format has no groups). Groups are numbered in the
/// order of their names. Returns how many faces each has, by name. `written`: what write_polyhedron would return.
std::map<std::string, std::size_t> write_groups(const std::string& path, const Polyhedron& labeled,
                                                const BoundaryGroups& groups,
                                                const PolyhedronWriteOptions& options = {},
                                                Messages* messages = nullptr, WrittenFile* written = nullptr);

}  // namespace nef
