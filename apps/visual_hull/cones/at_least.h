// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "apps/visual_hull/cones/bounds.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef::visual_hull {

/// The points that at least `least` of the closed cones hold, within the closed `room`: a closed set, exact. Each cone
/// is overlaid once with the subdivision that counts the cones before it; counts that decide nothing any more are one.
/// The subdivision may have as many volumes as the cones have cells.
nef::Polyhedron in_at_least(std::span<const nef::Polyhedron> cones, std::size_t least, const nef::Polyhedron& room,
                            const nef::Monitor& monitor);

/// A box around the points that at least `least` >= 1 of the cones hold, each of which is given by the half-spaces of
/// its convex hull: not the smallest one. Of m + 1 groups of cones a point that at most m cones lack lies in all cones
/// of some group, so the box around the groups' boxes holds it. kUnbounded if the groups that are tried have no boxes.
/// O(half-spaces) expected.
Bounds bounds_of_at_least(std::span<const std::vector<HalfSpace>> cones, std::size_t least);

}  // namespace nef::visual_hull
