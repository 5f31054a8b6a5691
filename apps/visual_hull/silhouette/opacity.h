// SPDX-License-Identifier: Apache-2.0
//
// Masks that say how much of a pixel the object covers.
#pragma once

#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// The opacity from which on a pixel counts as object; half lies between this and the number below.
inline constexpr int kObjectOpacity = 128;

/// The pixels (255, others 0) that an opacity (8 bits, one channel) shows as object.
cv::Mat object_of(const cv::Mat& opacity);

/// An opacity with the same object as a mask (8 bits, 255: object) and, at pixels beside its outline, the differences
/// between values (one channel) and a level, such that half lies at the level; 0 and 255 elsewhere. `full`: what the
/// values range over. Where a pixel is object at the other side of the level (a hole that was filled, a component that
/// was dropped) the outline keeps to the mask. O(pixels).
cv::Mat opacity_of(const cv::Mat& values, double level, double full, const cv::Mat& mask);

}  // namespace nef::visual_hull
