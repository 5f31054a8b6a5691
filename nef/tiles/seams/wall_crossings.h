// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/ids.h"
#include "nef/geometry/plane_table.h"
#include "nef/location/compare.h"

namespace nef {

/// An edge of a tile in the plane of a cut.
struct WallEdge {
  std::array<std::uint32_t, 2> points;  ///< its ends, ascending numbers
  bool above = false;                   ///< its tile lies above the cut
  std::uint32_t leaf = 0;
  HalfedgeId halfedge{0};
};

/// The planes that meet in a point.
using PlaneTriple = std::array<PlaneId, 3>;

/// Where edges of tiles above a cut cross edges of tiles below it, in the interior of both. Edges that both sides have
/// are left out: nothing of either side crosses them, and their points are not asked for. `point` gives the place of
/// one, `other_plane` a plane that holds an edge, other than that of the cut. O(n log n) expected for n edges that
/// cross few others.
std::vector<PlaneTriple> wall_crossings(const PlaneTable& planes, PlaneId cut, std::span<const WallEdge> edges,
                                        const Monitor& monitor, const std::function<PointRef(std::uint32_t)>& point,
                                        const std::function<PlaneId(const WallEdge&)>& other_plane);

}  // namespace nef
