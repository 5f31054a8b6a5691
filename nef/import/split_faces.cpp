// SPDX-License-Identifier: Apache-2.0
#include "nef/import/split_faces.h"

#include <algorithm>
#include <array>
#include <vector>

namespace nef {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles_of(const Mesh& mesh, const MeshSurface& surface, std::uint32_t face) {
  std::vector<Triangle> result;
  surface.for_each_triangle(mesh, face, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    result.push_back({a, b, c});
  });
  return result;
}

}  // namespace

std::optional<Mesh> split_faces(const Mesh& mesh, const MeshSurface& surface, std::span<const FaceContact> contacts) {
  std::vector<bool> split(mesh.face_count(), false);
  for (std::uint32_t f = 0; f < split.size(); ++f) split[f] = surface.defects[f] == FaceDefect::kCrossesItself;
  for (const FaceContact& contact : contacts) {
    if (contact.f == contact.g) split[contact.f] = true;
  }
  if (std::find(split.begin(), split.end(), true) == split.end()) return std::nullopt;
  Mesh result;
  result.vertices = mesh.vertices;
  std::vector<Triangle> more;
  for (std::uint32_t f = 0; f < split.size(); ++f) {
    if (!split[f]) {
      result.push_face(mesh.face(f));
      continue;
    }
    const std::vector<Triangle> triangles = triangles_of(mesh, surface, f);
    result.push_face(triangles[0]);
    more.insert(more.end(), triangles.begin() + 1, triangles.end());
  }
  for (const Triangle& t : more) result.push_face(t);
  return result;
}

}  // namespace nef
