// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of single rings, which may be no polygons, ear by ear.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/mesh/polygon/projected_corners.h"

namespace nef {

/// Cuts strictly convex corners off a ring whose triangle holds no other corner. Corners are compared by index, so that
/// a ring that meets itself is not in its own way. Keeps its memory from ring to ring.
class EarClipper {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Corners of a ring that loses its ears sooner than it is swept.
  static constexpr std::size_t kSmall = 24;

  /// Cuts a ring of three corners at least, and appends the triangles, between the points of its corners, to `out`.
  /// Returns false if there are no ears left before three corners are; what has been appended then is worth nothing.
  /// O(n) for convex polygons; with r corners that are not convex, each ear is compared with those of them that lie
  /// beside it along a coordinate axis: O(n r) at worst, with about a nanosecond a step.
  bool triangulate(const ProjectedCorners& corners, std::vector<Triangle>& out);

  /// The same for at most kSmall corners whose blunt ones are known (ProjectedCorners::blunt_corners).
  static bool triangulate_small(const ProjectedCorners& corners, std::uint32_t blunt, std::vector<Triangle>& out);

 private:
  class SmallRing;
  class LargeRing;

  struct Node {
    std::uint32_t prev = 0;
    std::uint32_t next = 0;
    bool blunt = false;  // not strictly convex
  };
  // Where a corner that is not convex lies along an axis of the projection, and which node it is.
  struct Place {
    double at = 0;
    double other = 0;  // along the other axis
    std::uint32_t node = 0;
  };
  // Corners that are not convex, in order along an axis; some may have become convex since.
  using Row = std::vector<Place>;

  std::vector<Node> nodes_;           // of each corner of a large ring: what is left of it
  std::vector<std::uint32_t> blunt_;  // nodes that may lie in an ear
  std::array<Row, 2> rows_;           // those that were among them when they were last sorted
};

}  // namespace nef
