// SPDX-License-Identifier: Apache-2.0
//
// Masks -> Silhouettes, and cameras that the silhouettes agree on.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/pipeline/run.h"
#include "apps/visual_hull/scene/place.h"

namespace nef::visual_hull {

/// Sets the silhouette of each view from its mask or, where the scene has them, its polygons; also, where `outlines`
/// has a place for each view, the silhouettes as they are before anything is simplified. Throws InputError for a mask
/// that shows nothing.
void add_silhouettes(const Run& run, const Scene& scene, std::vector<cv::Mat> masks, const SilhouetteOptions& options,
                     Result& result, std::vector<Silhouette>& outlines, const nef::Monitor& monitor);

/// Puts the cameras that the silhouettes agree on best in the place of those that were given.
void refine_views(const Run& run, const Scene& scene, const std::vector<Silhouette>& outlines, Result& result,
                  Place& place, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
