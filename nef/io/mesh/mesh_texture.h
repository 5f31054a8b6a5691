// SPDX-License-Identifier: Apache-2.0
//
// An image on the faces of a mesh, and the files that hold it beside those of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nef/mesh/mesh.h"

namespace nef {

/// An image on a mesh of triangles.
struct MeshTexture {
  std::string png;  ///< the bytes of a PNG file; none: there is no texture
  /// For each entry of Mesh::corners its place in the image, from (0, 0) at the lower left to (1, 1) at the upper
  /// right.
  std::vector<std::array<float, 2>> corners;
  std::string stem = {};  ///< what the names of files beside the mesh's begin with; write_mesh sets it

  [[nodiscard]] bool none() const { return png.empty(); }
};

/// The vertices of a textured mesh for formats in which a vertex has one place in the image: corners at one vertex with
/// different places become different vertices, in the order in which the corners first name them.
struct TexturedVertices {
  std::vector<std::uint32_t> vertex;         ///< of each of them, the vertex of the mesh
  std::vector<std::array<float, 2>> places;  ///< of each of them, in the image
  std::vector<std::uint32_t> corners;        ///< for each entry of Mesh::corners, one of them
};

/// O(n log n).
TexturedVertices textured_vertices(const Mesh& mesh, const MeshTexture& texture);

/// True if files of this extension hold the image of a texture themselves; else it is a file beside them.
bool has_image_inside(const std::string& extension);

/// Throws FileError if a texture cannot be written with a mesh in this format and to this path: the format has none,
/// faces are not triangles, corners are missing, or the format stores the image in a file beside `path`, which is not a
/// named file.
void require_texture(const std::string& path, const Mesh& mesh, const MeshTexture& texture,
                     const std::string& extension);

/// What the names of the files beside a mesh file begin with: NAME for FOLDER/NAME.obj, without white space.
std::string texture_stem(const std::string& path);
/// The name of the image file: STEM_texture.png.
std::string image_file_name(const std::string& stem);
/// The name of the file of materials beside an OBJ file: STEM.mtl.
std::string material_file_name(const std::string& stem);

/// Writes the files beside an OBJ or PLY file that its texture needs: the image, and for OBJ the material.
void write_texture_files(const std::string& path, const MeshTexture& texture, const std::string& extension);

}  // namespace nef
