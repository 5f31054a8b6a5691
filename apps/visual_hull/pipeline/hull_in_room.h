// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes, Box -> Hull.
#pragma once

#include <optional>

#include "apps/visual_hull/pipeline/room.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {

/// A hull, or why there is none with a volume.
struct FoundHull {
  nef::Polyhedron hull;
  bool direct = false;  ///< made vertex by vertex
  std::optional<Vanished> vanished;
};

/// The hull of the views in the room, in the coordinates of the place. Counts the facets of the cones that it makes in
/// `views`. Throws InputError if the direct way is asked for and does not do.
FoundHull hull_in_room(const Run& run, const Place& place, const Room& room, Views& views, PhaseReports& phases,
                       const nef::Monitor& monitor);

}  // namespace nef::visual_hull
