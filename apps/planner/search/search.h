// SPDX-License-Identifier: Apache-2.0
//
// A first path from start to goal, over a graph that is made as far as the search needs it.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/free_space/segments.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Way-points from start to goal within the filter, or the straight segment; each segment is free. A* over the cubes of
/// the free space's grid. From one cube that no boundary enters to the next there is nothing to ask; where the way has
/// to lead through others, free space is cut out around these, and its roadmap is made there alone: complete within
/// each cut, so that tight passages are found, too. Free space is to be locally at least `min_dimension`-dimensional,
/// which the filter must see to as well. Nothing after a few cuts in vain, which proves nothing. Each cut costs O(n) of
/// a Boolean operation, and a roadmap of what is in it.
std::optional<std::vector<Rational3>> corridor_path(const FreeSpace& free, const CellFilter& filter, int min_dimension,
                                                    const Rational3& start, const Rational3& goal,
                                                    const Monitor& monitor);

/// As corridor_path by the roadmap of all of free space (A* over portals), which is made if it is not there: nothing
/// if there is no path. With `clearance`, rather through volumes than in contact.
std::optional<std::vector<Rational3>> roadmap_path(const FreeSpace& free, const CellFilter& filter,
                                                   const Rational3& start, const Rational3& goal, bool clearance,
                                                   const Monitor& monitor);

}  // namespace nef::planner
