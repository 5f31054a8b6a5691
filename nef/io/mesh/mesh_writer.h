// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes to files of any format of the table in mesh_formats.h.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/face_groups.h"
#include "nef/io/mesh/mesh_texture.h"

namespace nef {

struct MeshFormat;

/// How a mesh is written. What a format can hold stands in the table of formats (mesh_formats.h).
struct MeshWriteOptions {
  /// Write exact coordinates (p/q) instead of the nearest doubles; text of formats with kFractions only.
  bool exact = false;
  /// Binary instead of text; formats of two forms only.
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
  /// Red, green and blue (sRGB) of every vertex, or none; PLY, GLB and 3MF only.
  std::vector<std::array<std::uint8_t, 3>> vertex_colors = {};
  /// An image on the faces, or none; not in OFF and STL, and neither with groups nor with colours of vertices. GLB and
  /// 3MF contain the image; the others name a file beside them (NAME_texture.png, and NAME.mtl of an OBJ).
  MeshTexture texture = {};
  /// What was subtracted from all coordinates of the mesh, which are written as they are: GLB and 3MF place the mesh
  /// there, so readers put it back; OFF, OBJ, PLY and STL note it in a comment or in the header. Dyadic.
  Rational3 offset = {};
  /// Who watches; what it refers to must outlive the call.
  Monitor monitor = {};
};

/// Writes a mesh in the format that the extension names (see mesh_formats.h), beside the target first and
/// then renamed into place. Coordinates are rounded once, to the nearest double (the nearest float in binary STL and
/// GLB), and written with the fewest digits that give it back. STL holds triangles only: polygons are cut. Throws
/// FileError for an unknown extension, options that the format does not have, coordinates beyond the range of its
/// numbers, or a file that cannot be written.
void write_mesh(const std::string& path, const Mesh& mesh, const MeshWriteOptions& options = {});

/// How many different vertices become one by rounding to single or double precision, in words; empty if none does.
/// Faces may be degenerate then. O(n log n).
std::string merged_vertices(const Mesh& mesh, bool single);

// The bytes of the single formats.
std::string off_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string obj_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string stl_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});
std::string ply_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});

/// Throws FileError if a coordinate has no finite number near it in the format.
void refuse_infinite(const Mesh& mesh, const MeshFormat& format, const MeshWriteOptions& options);
}  // namespace nef
