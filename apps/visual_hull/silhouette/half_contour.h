// SPDX-License-Identifier: Apache-2.0
//
// Outlines at half opacity.
#pragma once

#include "apps/visual_hull/polygon/polygon.h"
#include "apps/visual_hull/scene/scene.h"

#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// The line along which the opacity of an image (8 bits, one channel; nothing beyond the frame) is half, between
/// centres of pixels: marching squares (Lorensen and Cline 1987, in the plane). The vertices lie on the sides of the
/// squares of four centres, where the opacity along the side is half, rounded to a 256th of a pixel, at least as much
/// from either centre. Where two pixels of a square that have no side in common are object, they are joined if the mean
/// of the four is half or more. Rings are simple and have no point in common; a mask of 0 and 255 gives the edges of
/// its pixels with corners cut off. O(pixels).
Silhouette trace_half_contours(const cv::Mat& opacity, PixelOrigin origin, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
