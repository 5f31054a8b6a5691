// SPDX-License-Identifier: Apache-2.0
//
// One scene of several series of photographs of an object that was turned over in between: each view of each series
// cuts the hull, so the side that the object stood on in one series is seen in another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/visual_hull/combine/placement.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// A series that was placed among those before it.
struct PlacedSeries {
  std::string name;       ///< the scene's file
  std::size_t views = 0;  ///< its own
  Placement placement;
};

/// Several series as one.
struct Combined {
  Scene scene;  ///< all views, in the space of the first series, whose cameras are as they were; images by their paths
  std::vector<PlacedSeries> series;  ///< all but the first
  nef::Messages notes;               ///< also of series that have another place that fits nearly as well

  [[nodiscard]] bool fits() const;  ///< all series do
};

/// Reads scenes of one object and places each series among those before it by its silhouettes (placement.h), which are
/// made as `options` say (silhouette, mask, origin; nothing else counts). The hull of the scene is the intersection of
/// the hull of the first with those of the others, moved; the moved cameras are matrices of doubles. Views whose name
/// is taken get the number of their series in front, "2_NAME". Boxes of the scenes are dropped, with a note. Throws
/// InputError for fewer than two scenes; scenes of unknown or parallel cameras, of other mirroring, or of different
/// conventions for pixels or thresholds; and as compute does for images.
Combined combine(const std::vector<std::filesystem::path>& scenes, const Options& options);

}  // namespace nef::visual_hull
