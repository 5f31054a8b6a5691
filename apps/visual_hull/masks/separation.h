// SPDX-License-Identifier: Apache-2.0
//
// How well an outline separates an object from its background, and the level that separates best.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace nef::visual_hull {

/// The object among the pixels above a level: the largest component (by sides) that does not touch the frame of the
/// image, or the largest of all if no such one has a quarter of its area; holes of fewer pixels than 1/2000 of the
/// object, or than 20, are filled. 255 where the object is. O(pixels).
cv::Mat object_above(const cv::Mat& measure, double level);

/// What the pixels on both sides of an outline, 2 to 16 pixels from it, say.
struct Separation {
  double level = 0;  ///< best between both sides, by their means and standard deviations
  double quality =
      0;         ///< squared difference of the means over the sum of variances; 5 is clear, below 2 hardly anything
  int sign = 0;  ///< 1 if the inside is brighter, -1 if it is darker, 0 if one side has too few pixels
};

/// The separation of a mask (255: object) in a measure (one channel of 8 bits). A mask that runs along the frame has
/// its quality reduced: what bounds it there is no outline. The level is that of least error for two normal
/// distributions as Kittler and Illingworth (1986) have it, between means weighted by the other side's deviation.
Separation separation(const cv::Mat& measure, const cv::Mat& mask);

/// Starts from Otsu's level and repeats: object, its separation, the object above the new level. The last separation.
Separation fitted_separation(const cv::Mat& measure);

/// The median of a list that is not empty; of an even number of values the upper one of the middle.
double median_of(std::vector<double> values);

}  // namespace nef::visual_hull
