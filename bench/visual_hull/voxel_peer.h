// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull::bench {

/// Voxel carving as it is usually done: the volume of those of n^3 voxels of the result's box whose centres all masks
/// show. masks[i], one channel of 8 bits, is that of the result's view i.
double carve(const std::vector<cv::Mat>& masks, const Result& result, int n);

/// The silhouettes of a result as masks, for views that have no images.
std::vector<cv::Mat> drawn_masks(const Result& result, int width, int height);

}  // namespace nef::visual_hull::bench
