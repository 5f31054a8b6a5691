// SPDX-License-Identifier: Apache-2.0
//
// Making exact paths shorter. Every change is checked exactly before it is made, so a path stays a
// path; the doubles only decide what is tried.
#pragma once

#include <vector>

#include "apps/planner/free_space/segments.h"

namespace nef::planner {

using Waypoints = std::vector<Rational3>;

double length_of(const Waypoints& path);

/// Leaves way-points out where the straight segment is allowed. O(n^2) segment checks at worst.
/// With `clearance`, only where that does not trade a way through volumes for contact.
void shortcut(const FreeSpace& free, const CellFilter& filter, Waypoints& path, bool clearance);

/// Pulls the path tight: in the triangle of each way-point and its neighbours it is led around
/// the edges that cross the triangle; way-points on edges slide along them (thus a shortest path
/// in its class is approached to about 1e-12 of its length). Stops after `rounds` at the latest.
void tighten(const FreeSpace& free, const CellFilter& filter, Waypoints& path, int rounds);

/// The shortest path through the vertices of free space and some points of its edges, if it is
/// shorter than `path` (A* with lazy checks). Does nothing if there are more than `limit` such
/// points.
void take_shorter_way_round(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t limit);

/// Replaces way-point i (not an end) by the taut string from its predecessor to its successor
/// around all edges of free space that cross their triangle. What lies between the old corner and
/// the string holds no vertex of the plane section of the obstacles, so nothing can be in the way;
/// the new segments are checked all the same. Returns true if the path became shorter.
/// O(edges) per call.
bool pull_corner(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i);

}  // namespace nef::planner
