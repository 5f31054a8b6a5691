// SPDX-License-Identifier: Apache-2.0
//
// Polyhedra from and to files of every format, chosen by extension.
#pragma once

#include <string>

#include "nef/construct/construct.h"
#include "nef/io/mesh_writer.h"
#include "nef/polyhedron.h"

namespace nef {

/// Reads a polyhedron: .nef (the own format), .nef3 (CGAL's text), or a mesh (off, obj, stl, ply) that from_mesh makes
/// a solid of. `messages` gets what was done to the input. Throws InputError (FileError for the file itself) with the
/// path in front of the text.
Polyhedron read_polyhedron(const std::string& path, const MeshOptions& options = {}, Messages* messages = nullptr);

struct PolyhedronWriteOptions {
  bool exact = false;         ///< exact coordinates in mesh files (not STL)
  bool binary = false;        ///< binary STL or PLY
  bool text = false;          ///< .nef as text; it is binary otherwise
  bool keep_polygons = true;  ///< faces without holes that rounding leaves planar stay polygons in OFF, OBJ, PLY
};

/// Writes a polyhedron, beside the target first and then renamed into place. Mesh formats hold the boundary of the
/// bounded solid parts: `messages` gets a line for everything else that the set has, and for vertices that rounding
/// makes one. Throws FileError for an unknown extension or a file that cannot be written, and UnsupportedError for an
/// unbounded set in .nef3.
void write_polyhedron(const std::string& path, const Polyhedron& polyhedron, const PolyhedronWriteOptions& options = {},
                      Messages* messages = nullptr);

}  // namespace nef
