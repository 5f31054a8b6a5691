// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/surface/equal_faces.h"

#include <algorithm>

#include "nef/base/threads/first_equal.h"
#include "nef/base/threads/parallel.h"

namespace nef {

std::vector<std::uint32_t> first_with_corners(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor) {
  const auto has_corners = [&](std::size_t f) {
    return surface.defects[f] != FaceDefect::kBadIndex && !mesh.face(f).empty();
  };
  const auto hash = [&](std::size_t f) {
    if (!has_corners(f)) return mixed_bits(f);
    std::uint64_t sum = 0;  // in any order
    for (const std::uint32_t v : mesh.face(f)) sum += mixed_bits(surface.place[v]);
    return mixed_bits(sum);
  };
  const auto corners = [&](std::uint32_t f) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t v : mesh.face(f)) result.push_back(surface.place[v]);
    std::sort(result.begin(), result.end());
    return result;
  };
  return first_equal(
      mesh.face_count(), for_vertices(mesh.face_count(), monitor), hash,
      [&](std::uint32_t f, std::uint32_t g) { return has_corners(f) && has_corners(g) && corners(f) == corners(g); });
}

}  // namespace nef
