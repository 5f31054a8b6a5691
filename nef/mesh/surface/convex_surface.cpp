// SPDX-License-Identifier: Apache-2.0
//
// If all vertices of a solid but its corners lie strictly below the plane of a face, at least one does, and its ring is
// a strictly convex polygon, the face is a facet of the hull of these vertices, which spans space. Two faces are
// different facets unless they run through the same edges in the same direction; facets meet in edges and vertices that
// both have. If each edge is run through once in either direction, the neighbour of each facet is there, so all are.
// Solids in disjoint boxes have nothing in common.
#include "nef/mesh/surface/convex_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "nef/base/union_find.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {
namespace {

constexpr std::size_t kMostVertices = 64;  // as many as a word has bits
constexpr std::size_t kMostOfMany = 16;    // of each of several solids: the search takes less time for larger ones

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

// Items in groups, in their order in each.
class Groups {
 public:
  // `group_of` gives the group of each item; there are `count` groups.
  Groups(std::span<const std::uint32_t> group_of, std::size_t count) : begin_(count + 2, 0), items_(group_of.size()) {
    for (const std::uint32_t group : group_of) ++begin_[group + 2];
    for (std::size_t g = 2; g < begin_.size(); ++g) begin_[g] += begin_[g - 1];
    // A group begins one place too late, until all items of the one before are there.
    for (std::uint32_t i = 0; i < group_of.size(); ++i) items_[begin_[group_of[i] + 1]++] = i;
    begin_.pop_back();
  }

  [[nodiscard]] std::size_t count() const { return begin_.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(items_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::uint32_t> begin_, items_;
};

class ConvexSolids {
 public:
  ConvexSolids(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor)
      : mesh_(mesh), surface_(surface), monitor_(monitor) {}

  bool are_all() {
    if (mesh_.vertices.size() < 4 || mesh_.face_count() > 2 * mesh_.vertices.size() || !find_parts()) return false;
    const Groups faces(part_of_face_, part_count_);
    const Groups vertices(part_of_vertex_, part_count_);
    number_.resize(mesh_.vertices.size());
    for (std::size_t part = 0; part < part_count_; ++part) {
      if (!is_convex(vertices[part], faces[part])) return false;
    }
    return part_count_ == 1 || are_apart(vertices);
  }

 private:
  // Vertices that faces join are of one part. False if a part is large, or a face or vertex is not an ordinary one.
  bool find_parts() {
    const std::size_t count = mesh_.vertices.size();
    const std::size_t most = count <= kMostVertices ? kMostVertices : kMostOfMany;
    UnionFind parts(count);
    std::vector<std::uint8_t> size(count, 1);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      if (!is_one_convex_piece(surface_, f)) return false;
      const auto ring = mesh_.face(f);
      std::uint32_t root = parts.find(ring[0]);
      for (const std::uint32_t v : ring) {
        if (surface_.place[v] != v) return false;
        const std::uint32_t other = parts.find(v);
        if (other == root) continue;
        const std::size_t joined = std::size_t{size[root]} + size[other];
        if (joined > most) return false;
        parts.unite(root, other);
        root = std::min(root, other);
        size[root] = static_cast<std::uint8_t>(joined);
      }
    }
    parts.flatten();
    part_of_vertex_.resize(count);
    for (std::uint32_t v = 0; v < count; ++v) {
      const std::uint32_t root = parts.root(v);
      part_of_vertex_[v] = root == v ? part_count_++ : part_of_vertex_[root];
    }
    part_of_face_.resize(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) part_of_face_[f] = part_of_vertex_[mesh_.face(f)[0]];
    return true;
  }

  bool is_convex(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> faces) {
    const auto count = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) number_[vertices[i]] = i;
    std::array<VertexSet, kMostVertices> next{};  // of each vertex: the ends of edges that faces run through from there
    for (const std::uint32_t f : faces) {
      VertexSet corners = 0;
      bool is_new = true;
      for_each_side(mesh_.face(f), [&](std::uint32_t u, std::uint32_t v) {
        const VertexSet end = only(number_[v]);
        VertexSet& ends = next[number_[u]];
        is_new = is_new && (ends & end) == 0;
        ends |= end;
        corners |= end;
      });
      if (!is_new) return false;
      if (static_cast<std::uint32_t>(std::popcount(corners)) == count) return false;  // both sides of a polygon, say
      for (std::uint32_t i = 0; i < count; ++i) {
        if ((corners & only(i)) == 0 && !is_below(surface_, f, vertices[i], monitor_)) return false;
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      if (next[i] == 0) return false;  // of no face
      for (VertexSet ends = next[i]; ends != 0; ends &= ends - 1) {
        if ((next[std::countr_zero(ends)] & only(i)) == 0) return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool are_apart(const Groups& vertices) const {
    std::vector<Box> boxes(vertices.count());
    for (std::size_t part = 0; part < boxes.size(); ++part) {
      for (const std::uint32_t v : vertices[part]) surface_.points.extend(boxes[part], v);
    }
    bool apart = true;
    BoxTree(boxes).for_each_pair([&apart](std::uint32_t /*i*/, std::uint32_t /*j*/) { apart = false; });
    return apart;
  }

  const Mesh& mesh_;
  const MeshSurface& surface_;
  const Monitor& monitor_;
  std::uint32_t part_count_ = 0;
  std::vector<std::uint32_t> part_of_vertex_, part_of_face_;
  std::vector<std::uint32_t> number_;  // of a vertex, in its part
};

}  // namespace

bool bounds_small_convex_solids(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor) {
  try {
    return ConvexSolids(mesh, surface, monitor).are_all();
  } catch (const OpenQuestion&) {
    return false;
  }
}

}  // namespace nef
