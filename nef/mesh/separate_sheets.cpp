// SPDX-License-Identifier: Apache-2.0
//
// Sides of faces are paired across edges: of four sides around an edge, those two that have the solid between them. The
// corners that come together through such pairs are one vertex.
#include "nef/mesh/separate_sheets.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/area_vector.h"
#include "nef/mesh/edge_order.h"

namespace nef {
namespace {

/// The side of a face from its corner `corner` (in the mesh's list) to the next one.
struct FaceSide {
  std::uint64_t key = 0;  // the smaller vertex first
  std::uint32_t face = 0;
  std::uint32_t corner = 0;
  std::uint32_t next = 0;
  bool forward = false;  // from the smaller vertex
};

class Separator {
 public:
  explicit Separator(const Mesh& mesh) : mesh_(mesh), corners_(mesh.corners.size()) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const std::uint32_t begin = mesh.face_begin[f];
      const std::uint32_t end = mesh.face_begin[f + 1];
      for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t next = c + 1 < end ? c + 1 : begin;
        const std::uint32_t u = mesh.corners[c];
        const std::uint32_t v = mesh.corners[next];
        sides_.push_back({edge_key(u, v), f, c, next, u < v});
      }
    }
    sort_by_pair(sides_, mesh.vertices.size());
  }

  SeparatedSheets run() {
    for (std::size_t i = 0; i < sides_.size();) {
      std::size_t end = i + 1;
      while (end < sides_.size() && sides_[end].key == sides_[i].key) ++end;
      pair_sides(std::span(sides_).subspan(i, end - i));
      i = end;
    }
    number_vertices();
    cut_edges();
    return std::move(result_);
  }

 private:
  void join(const FaceSide& a, const FaceSide& b) {
    corners_.unite(a.corner, b.next);
    corners_.unite(a.next, b.corner);
  }

  void pair_sides(std::span<FaceSide> sides) {
    const auto forward = std::count_if(sides.begin(), sides.end(), [](const FaceSide& s) { return s.forward; });
    if (2 * forward != static_cast<std::ptrdiff_t>(sides.size())) {
      throw InputError("the mesh is not closed: an edge of vertex " + std::to_string(mesh_.corners[sides[0].corner]) +
                       " is not used equally often in both directions");
    }
    if (sides.size() == 2) return join(sides[0], sides[1]);
    ++result_.edges;
    sort_around(sides);
    // Counterclockwise about the edge, the solid lies behind a backward side and before a forward one.
    std::size_t first = 0;
    while (sides[first].forward) ++first;
    for (std::size_t k = 0; k < sides.size(); k += 2) {
      const FaceSide& backward = sides[(first + k) % sides.size()];
      const FaceSide& ahead = sides[(first + k + 1) % sides.size()];
      if (backward.forward || !ahead.forward) throw InputError("the faces around an edge do not bound a solid");
      join(backward, ahead);
      pinched_.push_back({backward, ahead});
    }
  }

  // By the directions in which the faces leave the edge.
  void sort_around(std::span<FaceSide> sides) const {
    const auto [u, v] = ends(sides[0]);
    const Rational3 along = minus(mesh_.vertices[v], mesh_.vertices[u]);
    std::vector<Rational3> direction;
    for (const FaceSide& side : sides) {
      const Rational3 w = cross(area_vector(mesh_, mesh_.face(side.face)), along);
      direction.push_back(side.forward ? w : opposite(w));
    }
    // The first direction and what lies less than half a turn behind it comes first.
    const auto upper = [&](const Rational3& w) {
      const int turn = sgn(dot(along, cross(direction[0], w)));
      return turn > 0 || (turn == 0 && sgn(dot(direction[0], w)) > 0);
    };
    std::vector<std::size_t> order(sides.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const bool upper_a = upper(direction[a]);
      const bool upper_b = upper(direction[b]);
      if (upper_a != upper_b) return upper_a;
      return sgn(dot(along, cross(direction[a], direction[b]))) > 0;
    });
    std::vector<FaceSide> sorted;
    for (const std::size_t k : order) sorted.push_back(sides[k]);
    std::copy(sorted.begin(), sorted.end(), sides.begin());
  }

  static std::array<std::uint32_t, 2> ends(const FaceSide& side) {
    return {static_cast<std::uint32_t>(side.key >> 32U), static_cast<std::uint32_t>(side.key)};
  }

  // The first corner of a vertex keeps its number, others get new ones behind.
  void number_vertices() {
    result_.mesh = mesh_;
    std::vector<bool> taken(mesh_.vertices.size(), false);
    std::vector<std::uint32_t> number(mesh_.corners.size(), UINT32_MAX);
    for (std::uint32_t c = 0; c < mesh_.corners.size(); ++c) {
      std::uint32_t& own = number[corners_.find(c)];
      if (own == UINT32_MAX) {
        const std::uint32_t vertex = mesh_.corners[c];
        own = taken[vertex] ? add_vertex(Rational3(mesh_.vertices[vertex])) : vertex;
        taken[vertex] = true;
      }
      result_.mesh.corners[c] = own;
    }
  }

  std::uint32_t add_vertex(Rational3 point) {
    ++result_.copies;
    result_.mesh.vertices.push_back(std::move(point));
    return static_cast<std::uint32_t>(result_.mesh.vertices.size() - 1);
  }

  // Pairs at one edge whose ends are the same two vertices all the same.
  void cut_edges() {
    struct Pair {
      std::uint64_t key = 0;
      std::uint32_t index = 0;
    };
    std::vector<Pair> pairs;
    for (std::uint32_t p = 0; p < pinched_.size(); ++p) {
      const std::uint32_t u = result_.mesh.corners[pinched_[p][1].corner];
      const std::uint32_t v = result_.mesh.corners[pinched_[p][1].next];
      pairs.push_back({edge_key(u, v), p});
    }
    sort_by_pair(pairs, result_.mesh.vertices.size());
    std::vector<std::uint32_t> middle(mesh_.corners.size(), UINT32_MAX);  // in the side that begins at a corner
    bool any = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const bool alone =
          (k == 0 || pairs[k - 1].key != pairs[k].key) && (k + 1 == pairs.size() || pairs[k + 1].key != pairs[k].key);
      if (alone) continue;
      any = true;
      const auto& pair = pinched_[pairs[k].index];
      const auto [u, v] = ends(pair[0]);
      middle[pair[0].corner] = middle[pair[1].corner] =
          add_vertex(mean_of<Rational>(std::array{mesh_.vertices[u], mesh_.vertices[v]}));
    }
    if (any) insert(middle);
  }

  // A face with middles on its sides becomes triangles around the first of them.
  void insert(const std::vector<std::uint32_t>& middle) {
    const Mesh before = std::move(result_.mesh);
    Mesh after;
    after.vertices = before.vertices;
    for (std::uint32_t f = 0; f < before.face_count(); ++f) {
      std::vector<std::uint32_t> ring;
      std::size_t first = SIZE_MAX;
      for (std::uint32_t c = before.face_begin[f]; c < before.face_begin[f + 1]; ++c) {
        ring.push_back(before.corners[c]);
        if (middle[c] == UINT32_MAX) continue;
        if (first == SIZE_MAX) first = ring.size();
        ring.push_back(middle[c]);
      }
      if (first == SIZE_MAX) {
        after.push_face(ring);
        continue;
      }
      std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
      for (std::size_t k = 1; k + 1 < ring.size(); ++k) after.push_face(std::array{ring[0], ring[k], ring[k + 1]});
    }
    result_.mesh = std::move(after);
  }

  const Mesh& mesh_;
  std::vector<FaceSide> sides_;
  UnionFind corners_;  // at one vertex
  std::vector<std::array<FaceSide, 2>> pinched_;
  SeparatedSheets result_;
};

}  // namespace

SeparatedSheets separate_sheets(const Mesh& mesh) { return Separator(mesh).run(); }

}  // namespace nef
