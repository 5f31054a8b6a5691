// SPDX-License-Identifier: Apache-2.0
//
// If all vertices but its corners lie strictly below the plane of a face, at least one does, and its ring is a strictly
// convex polygon, the face is a facet of the hull of all vertices, which spans space. Two faces are different facets
// unless they run through the same edges in the same direction; facets meet in edges and vertices that both have. If
// each edge is run through once in either direction, the neighbour of each facet is there, so all are.
#include "nef/mesh/surface/convex_surface.h"

#include <algorithm>
#include <array>
#include <bit>

namespace nef {
namespace {

constexpr std::size_t kMostVertices = 64;  // as many as a word has bits

using VertexSet = std::uint64_t;

VertexSet only(std::uint32_t vertex) { return VertexSet{1} << vertex; }

bool is_one_convex_piece(const MeshSurface& surface, std::uint32_t face) {
  const std::uint32_t begin = surface.triangle_begin[face];
  const std::uint32_t end = surface.triangle_begin[face + 1];
  return surface.defects[face] == FaceDefect::kNone && surface.planar[face] && !surface.irregular[face] &&
         begin < end && surface.pieces[begin] == surface.pieces[end - 1];
}

bool is_below(const MeshSurface& surface, std::uint32_t face, std::uint32_t vertex, const Monitor& monitor) {
  const std::array<std::uint32_t, 3>& plane = surface.triangles[surface.triangle_begin[face]];
  return surface.points.orientation(plane[0], plane[1], plane[2], vertex, monitor) < 0;
}

}  // namespace

bool bounds_small_convex_solid(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor) {
  const std::size_t count = mesh.vertices.size();
  if (count < 4 || count > kMostVertices || mesh.face_count() > 2 * count) return false;
  std::array<VertexSet, kMostVertices> next{};  // of each vertex: the ends of edges that faces run through from there
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (!is_one_convex_piece(surface, f)) return false;
    const auto ring = mesh.face(f);
    VertexSet corners = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const VertexSet end = only(ring[i + 1 == ring.size() ? 0 : i + 1]);
      if (surface.place[ring[i]] != ring[i] || (next[ring[i]] & end) != 0) return false;
      next[ring[i]] |= end;
      corners |= end;
    }
    if (static_cast<std::size_t>(std::popcount(corners)) == count) return false;  // both sides of a polygon, say
    for (std::uint32_t v = 0; v < count; ++v) {
      if ((corners & only(v)) == 0 && !is_below(surface, f, v, monitor)) return false;
    }
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    if (next[v] == 0) return false;  // of no face
    for (std::uint32_t w = 0; w < count; ++w) {
      if ((next[v] & only(w)) != 0 && (next[w] & only(v)) == 0) return false;
    }
  }
  return true;
}

}  // namespace nef
