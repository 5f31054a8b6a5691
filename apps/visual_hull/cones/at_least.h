// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace visual_hull {

/// The points that at least `least` of the closed cones hold, within the closed `room`: a closed set, exact. Each cone
/// is overlaid once with the subdivision that counts the cones before it; counts that decide nothing any more are one.
/// The subdivision may have as many volumes as the cones have cells.
nef::Polyhedron in_at_least(std::span<const nef::Polyhedron> cones, std::size_t least, const nef::Polyhedron& room,
                            const nef::Monitor& monitor);

}  // namespace visual_hull
