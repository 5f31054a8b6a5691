// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes -> Box, and the views that contradict the others.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/pipeline/run.h"
#include "apps/visual_hull/scene/place.h"

namespace nef::visual_hull {

/// The box to look at, in the coordinates of the place.
struct Room {
  WorldBox box;
  bool found = false;                 ///< from the cones
  std::optional<WorldBox> enclosing;  ///< known to hold the hull in its interior
  bool empty = false;                 ///< the convex hulls of the cones have no common point; the box is a guess
};

/// The box that was given, or one around what all cones (or as many as are asked for) have in common. Throws InputError
/// for a box without an inside, and where there is none and the cones do not bound the scene.
Room room_of(const Scene& scene, const Options& options, const Views& views, const Place& place,
             const nef::Monitor& monitor);

/// Compares the views and, if that is asked for, leaves out the guilty ones. The room is found anew without them.
void compare(const Run& run, const Scene& scene, Result& result, Place& place, Room& room, const nef::Monitor& monitor);

/// The views that are compared with others: all but those that keep what they do not see.
std::vector<ComparedView> compared(const Views& views, const Place& place);

/// True if outlines are so detailed that a hull is made faster vertex by vertex.
bool worth_direct(const Views& views);

}  // namespace nef::visual_hull
