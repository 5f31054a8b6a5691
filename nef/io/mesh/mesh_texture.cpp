// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/mesh_texture.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <tuple>

#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"

namespace nef {
namespace {

namespace fs = std::filesystem;

std::string beside(const std::string& path, const std::string& name) {
  return (fs::path(path).parent_path() / name).string();
}

[[noreturn]] void refuse_texture(const std::string& path, const std::string& what) {
  throw FileError(FileProblem::kUnsupported, path + ": " + what);
}

}  // namespace

TexturedVertices textured_vertices(const Mesh& mesh, const MeshTexture& texture) {
  // Corners in the order of vertex and place; equal ones are one vertex, numbered by the first of them.
  std::vector<std::uint32_t> order(mesh.corners.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t c) { return std::tuple(mesh.corners[c], texture.corners[c]); };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  TexturedVertices result;
  result.corners.resize(order.size());
  for (std::uint32_t c = 0; c < order.size(); ++c) {
    if (first[c] == c) {
      result.corners[c] = static_cast<std::uint32_t>(result.vertex.size());
      result.vertex.push_back(mesh.corners[c]);
      result.places.push_back(texture.corners[c]);
    } else {
      result.corners[c] = result.corners[first[c]];
    }
  }
  return result;
}

bool has_image_inside(const std::string& extension) { return extension == "glb" || extension == "3mf"; }

void require_texture(const std::string& path, const Mesh& mesh, const MeshTexture& texture,
                     const std::string& extension) {
  if (!mesh_format_of(path, extension).has(kTexture)) {
    refuse_texture(path, "the format has no textures; write " + mesh_format_names(kTexture));
  }
  bool triangles = texture.corners.size() == mesh.corners.size();
  for (std::size_t f = 0; triangles && f < mesh.face_count(); ++f) triangles = mesh.face(f).size() == 3;
  if (!triangles) refuse_texture(path, "a texture needs triangles and a place in the image for each of their corners");
  if (has_image_inside(extension)) return;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path == "-" || (fs::exists(status) && !fs::is_regular_file(status))) {
    refuse_texture(path, "this format stores a texture in a file beside it: name a file, or write GLB or 3MF");
  }
}

// Some readers take a name in an OBJ or PLY file up to the first white space.
std::string texture_stem(const std::string& path) {
  std::string stem = fs::path(path).stem().string();
  for (char& c : stem) {
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') c = '_';
  }
  return stem;
}

std::string image_file_name(const std::string& stem) { return stem + "_texture.png"; }

std::string material_file_name(const std::string& stem) { return stem + ".mtl"; }

void write_texture_files(const std::string& path, const MeshTexture& texture, const std::string& extension) {
  if (has_image_inside(extension)) return;
  const std::string stem = texture_stem(path);
  const std::string image = image_file_name(stem);
  write_file(beside(path, image), texture.png);
  if (extension != "obj") return;
  write_file(beside(path, material_file_name(stem)),
             "newmtl texture\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " + image + "\n");
}

}  // namespace nef
