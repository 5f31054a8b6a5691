// SPDX-License-Identifier: Apache-2.0
//
// Why a hull has no volume.
#pragma once

#include <vector>

#include "apps/visual_hull/cones/intersection.h"
#include "apps/visual_hull/pipeline/room.h"

namespace nef::visual_hull {

/// Why the hull is empty: small sets of views that have no point in common, where there are some.
Vanished explain_empty(const Run& run, const Views& views, const Place& place, const Room& room,
                       const nef::Monitor& monitor);

/// At which view the last volume went, of a hull that has points, edges or facets only. `parts` are what the views
/// leave of the room, at least one.
Vanished explain_flat(const Views& views, const Room& room, const std::vector<Part>& parts,
                      const nef::Monitor& monitor);

}  // namespace nef::visual_hull
