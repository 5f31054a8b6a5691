// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::minkowski {

/// Cuts polygons into convex ones between their own corners.
class ConvexPieces {
 public:
  /// The points must outlive the object.
  ConvexPieces(const MeshPoints& points, const Monitor& monitor)
      : monitor_(monitor), points_(points), triangulator_(points_, monitor) {}

  /// Cuts a polygon, given by its rings as Triangulator takes them, into pieces that are turned like it. Triangles of a
  /// triangulation are merged as long as what comes of it is convex [Hertel, Mehlhorn 1983], but not across sides that
  /// rings walk both ways: at most four times as many as there must be. A piece of very many corners, which would be
  /// asked one by one whatever comes near the piece, is cut into some of about 32. O(n log n), O(n) for a convex
  /// polygon.
  std::vector<std::vector<std::uint32_t>> cut(const std::vector<std::vector<std::uint32_t>>& rings,
                                              const ProjectionAxis& projection);

 private:
  using Ring = std::vector<std::uint32_t>;

  // A corner of a triangle, three in a row, in the ring of the piece that the triangle is in.
  struct Corner {
    std::uint32_t vertex, prev, next;
    std::uint32_t across;  // the corner where the triangle beyond the side to the next corner runs through it; or kNone
  };
  struct Side {
    std::uint64_t key;
    std::uint32_t corner;
  };
  // A triangle, and the corner before the side that a ring has in common with it.
  struct Candidate {
    std::uint32_t triangle, corner;
  };

  [[nodiscard]] bool turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool is_convex(const Ring& ring) const;
  void find_slits(const std::vector<Ring>& rings);
  [[nodiscard]] bool is_slit(std::uint32_t u, std::uint32_t v) const;
  void link(const std::vector<Triangulator::Triangle>& triangles);
  bool merge(std::uint32_t corner);
  Ring grown(std::uint32_t triangle);
  [[nodiscard]] bool is_straight(std::span<const std::uint32_t> corners) const;
  void append_small(Ring&& ring, std::vector<Ring>& pieces) const;

  Monitor monitor_;
  const MeshPoints& points_;
  Triangulator triangulator_;
  std::unordered_set<std::uint64_t> sides_;  // of the polygon at hand, from vertex to vertex
  std::vector<Corner> corners_;              // of its triangles
  std::vector<bool> taken_;                  // into a piece
  std::vector<Candidate> candidates_;        // a heap, the first triangle on top
  std::size_t axis_ = 0;
  int sign_ = 1;
};

}  // namespace nef::minkowski
