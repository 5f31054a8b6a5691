// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes to files: OFF, OBJ, STL and PLY.
#pragma once

#include <string>

#include "nef/construct/construct.h"

namespace nef {

struct MeshWriteOptions {
  /// Write exact coordinates (p/q) instead of the nearest doubles; OFF, OBJ and text PLY only.
  bool exact = false;
  /// Binary STL (single precision) or PLY (doubles) instead of text.
  bool binary = false;
};

/// Writes a mesh in the format that the extension names (off, obj, stl, ply), beside the target first and then renamed
/// into place. Coordinates are rounded once, to the nearest double (the nearest float in binary STL), and
/// written with the fewest digits that give it back. STL holds triangles only: polygons are cut.
/// Adds a line to `messages` where different vertices become one by rounding. Throws FileError for an unknown
/// extension, options that the format does not have, or a file that cannot be written.
void write_mesh(const std::string& path, const Mesh& mesh, const MeshWriteOptions& options = {},
                Messages* messages = nullptr);

// The bytes of the single formats.
std::string off_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string obj_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string stl_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string ply_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});

/// True if a point is the same after it was written to the format of that extension (off, obj, stl, ply) and read
/// again: its coordinates are short decimals in text, doubles or floats in binary. Polygons of such points stay planar.
bool survives_writing(const Rational3& point, const std::string& extension, const MeshWriteOptions& options);

}  // namespace nef
