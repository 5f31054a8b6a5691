// SPDX-License-Identifier: Apache-2.0
//
// Neighbouring coplanar polygons of a surface, united to larger ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// Polygons that tile one larger polygon, which may have holes.
struct CoplanarGroup {
  std::vector<std::uint32_t> members;    ///< the polygons, in increasing order
  std::vector<std::uint32_t> cycles;     ///< corners of the border: the outer cycle or a hole, one after the other
  std::vector<std::uint32_t> cycle_end;  ///< of each cycle in `cycles`
};

/// Groups strictly convex polygons, each in a plane of its own, that lie in a common plane and are joined by edges of
/// exactly two polygons, in two proofs that the members of a group overlap nowhere: they are oriented alike, so that a
/// point is covered as often as the border winds around it; and the border is one simple outer cycle with simple holes,
/// which winds around no point twice. What fails that test is in no group, nor are single polygons. A polygon without
/// corners stands for one that belongs to no group. O(n log n) unless many boxes of sides overlap.
std::vector<CoplanarGroup> coplanar_groups(const MeshPoints& points,
                                           const std::vector<std::span<const std::uint32_t>>& polygons,
                                           const Monitor& monitor);

}  // namespace nef
