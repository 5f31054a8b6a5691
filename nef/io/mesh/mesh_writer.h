// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes to files: OFF, OBJ, STL, PLY, GLB and 3MF.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/face_groups.h"

namespace nef {

struct MeshWriteOptions {
  /// Write exact coordinates (p/q) instead of the nearest doubles; OFF, OBJ and text PLY only.
  bool exact = false;
  /// Binary STL (single precision) or PLY (doubles) instead of text.
  bool binary = false;
  /// Instead of the extension of the path.
  std::string format = {};
  /// Between vertices of the mesh; OBJ only.
  std::vector<std::array<std::uint32_t, 2>> lines = {};
  /// Vertices of the mesh that stand for themselves; OBJ only.
  std::vector<std::uint32_t> points = {};
  /// Groups of faces: `g name` in OBJ, colours in OFF, numbers and colours (names as comments) in PLY, named materials
  /// in GLB. Other formats have none.
  FaceGroups groups = {};
  /// Red, green and blue (sRGB) of every vertex, or none; PLY and GLB only.
  std::vector<std::array<std::uint8_t, 3>> vertex_colors = {};
  /// What was subtracted from all coordinates of the mesh, which are written as they are: GLB and 3MF place the mesh
  /// there, so readers put it back; OFF, OBJ, PLY and STL note it in a comment or in the header. Dyadic.
  Rational3 offset = {};
  /// Who watches; what it refers to must outlive the call.
  Monitor monitor = {};
};

/// Writes a mesh in the format that the extension names (off, obj, stl, ply, glb, 3mf), beside the target first and
/// then renamed into place. Coordinates are rounded once, to the nearest double (the nearest float in binary STL and
/// GLB), and written with the fewest digits that give it back. STL holds triangles only: polygons are cut. Throws
/// FileError for an unknown extension, options that the format does not have, coordinates beyond the range of its
/// numbers, or a file that cannot be written.
void write_mesh(const std::string& path, const Mesh& mesh, const MeshWriteOptions& options = {});

/// How many different vertices become one by rounding to single or double precision, in words; empty if none does.
/// Faces may be degenerate then. O(n log n).
std::string merged_vertices(const Mesh& mesh, bool single);

/// True if a format holds colours of vertices.
bool has_vertex_colors(const std::string& extension);

/// True if a format holds groups of faces.
bool has_groups(const std::string& extension);

// The bytes of the single formats.
std::string off_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string obj_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string stl_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string ply_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});

/// Throws FileError if a coordinate has no finite number near it in the format.
void refuse_infinite(const Mesh& mesh, const std::string& extension, const MeshWriteOptions& options);

/// True if the format holds coordinates in single precision.
bool is_single_precision(const std::string& extension, const MeshWriteOptions& options);

/// True if a point is the same after it was written to the format of that extension and read
/// again: its coordinates are short decimals in text, doubles or floats in binary. Polygons of such points stay planar.
bool survives_writing(const Rational3& point, const std::string& extension, const MeshWriteOptions& options);

}  // namespace nef
