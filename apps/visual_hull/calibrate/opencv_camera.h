// SPDX-License-Identifier: Apache-2.0
//
// A lens and a pose as OpenCV has them.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull {

/// The camera's matrix: focal lengths and principal point.
cv::Mat opencv_matrix(const Lens& lens);

/// A pose as a vector of rotation (axis times angle) and a shift, three doubles each.
struct OpenCvPose {
  cv::Mat rotation;
  cv::Mat shift;

  [[nodiscard]] static OpenCvPose of(const Pose& pose);
  [[nodiscard]] Pose pose() const;
};

/// Where a camera sees points, in pixels whose centres are whole numbers.
std::vector<cv::Point2d> seen_points(const std::vector<cv::Point3d>& points, const Lens& lens, const OpenCvPose& pose);

/// How these places move, two rows a point: with the three numbers of the rotation, the three of the shift, fx, fy, cx,
/// cy and the coefficients of distortion.
cv::Mat derivatives_of_seen(const std::vector<cv::Point3d>& points, const Lens& lens, const OpenCvPose& pose);

}  // namespace nef::visual_hull
