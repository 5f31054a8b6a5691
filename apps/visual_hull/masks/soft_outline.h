// SPDX-License-Identifier: Apache-2.0
//
// Outlines of masks to a fraction of a pixel.
#pragma once

#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// The opacity (silhouette/opacity.h) of a mask (255: object) that was cut out of a measure (one channel of 8 bits,
/// larger for the object): within two pixels of the outline half lies midway between the means of object and
/// background near by, each taken two pixels or more from the outline, over 9 by 9 pixels. So the outline does not
/// depend on the level that the mask was made with, nor on shades along it. The object is the largest component again,
/// as in `object_above`. Outlines without any such pixels of both kinds near by stay along pixels. O(pixels).
cv::Mat soft_outline(const cv::Mat& measure, const cv::Mat& mask);

}  // namespace nef::visual_hull
