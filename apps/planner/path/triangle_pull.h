// SPDX-License-Identifier: Apache-2.0
//
// One step of pulling a path tight.
#pragma once

#include "apps/planner/path/shorten.h"

namespace nef::planner {

/// Replaces way-point i (not an end) by the taut string from its predecessor to its successor
/// around all edges of free space that cross their triangle. What lies between the old corner and
/// the string holds no vertex of the plane section of the obstacles, so nothing can be in the way;
/// the new segments are checked all the same. Returns true if the path became shorter.
/// O(edges) per call.
bool pull_corner(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i);

}  // namespace nef::planner
