// SPDX-License-Identifier: Apache-2.0
//
// Three ways to a first path, from the cheapest to the complete one.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/free_space/segments.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Way-points from start to goal within the filter through cubes of space that no boundary enters (A*), or the straight
/// segment; each segment is free. Nothing where free space is too narrow for that, which proves nothing. Needs no
/// roadmap.
std::optional<std::vector<Rational3>> wide_way(const FreeSpace& free, const CellFilter& filter, const Rational3& start,
                                               const Rational3& goal, const Monitor& monitor);

/// As wide_way, but where the way has to lead through cubes that the boundary enters, free space is cut out around
/// these, and its roadmap is made there alone: complete within each cut, so that tight passages are found, too. Free
/// space is to be locally at least `min_dimension`-dimensional, which the filter must see to as well. Nothing after a
/// few cuts in vain, which proves nothing. Each cut costs O(n) of a Boolean operation, and a roadmap of what is in it.
std::optional<std::vector<Rational3>> narrow_way(const FreeSpace& free, const CellFilter& filter, int min_dimension,
                                                 const Rational3& start, const Rational3& goal, const Monitor& monitor);

/// The roadmap's way-points from start to goal within the filter (A* over stations); each segment is checked. Nothing
/// if there is no path.
std::optional<std::vector<Rational3>> roadmap_path(const FreeSpace& free, const CellFilter& filter,
                                                   const Rational3& start, const Rational3& goal, bool clearance,
                                                   const Monitor& monitor);

}  // namespace nef::planner
