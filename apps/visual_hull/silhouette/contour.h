// SPDX-License-Identifier: Apache-2.0
//
// The exact boundary of a set of pixels.
#pragma once

#include <opencv2/core.hpp>

#include "apps/visual_hull/polygon/polygon.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// What becomes of a corner in which two pixels of the object meet that have no side in common.
enum class DiagonalPixels : std::uint8_t {
  kTouch,  ///< it stays as it is: a vertex of two rings, and a line in which the hull touches itself
  kJoin,   ///< the pixels are joined: a quarter of the sides that meet there is cut off, to their outside
};

/// The boundary of the union of the closed pixels that are not zero in `mask` (8 bits, one
/// channel), along the edges of the pixels, as simple rings that meet in corners at most: where
/// two pixels touch in a corner only, so do the rings, or with kJoin none do. Straight runs are one edge. Unlike
/// contours through pixel centres this loses no half pixel on either side. O(pixels).
Silhouette trace_contours(const cv::Mat& mask, PixelOrigin origin, DiagonalPixels diagonal = DiagonalPixels::kTouch,
                          const nef::Monitor& monitor = {});

/// True if a pixel of the mask on the frame of the image is set.
bool touches_frame(const cv::Mat& mask);

}  // namespace nef::visual_hull
