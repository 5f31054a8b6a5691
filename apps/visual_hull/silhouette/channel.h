// SPDX-License-Identifier: Apache-2.0
//
// The values of an image that a threshold is compared with.
#pragma once

#include <opencv2/core.hpp>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// The largest value that pixels of this depth (CV_8U, ...) have by convention: 255, ..., 1 for floating point.
double full_scale(int depth);

/// One channel of an image, of the image's depth. The image has one, three (blue, green, red) or four channels. Throws
/// InputError if it has no such channel. O(pixels).
cv::Mat pick_channel(const cv::Mat& image, ThresholdOptions::Channel channel);

}  // namespace nef::visual_hull
