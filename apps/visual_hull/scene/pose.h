// SPDX-License-Identifier: Apache-2.0
//
// Cameras as calibration programs give them: a lens and a pose, in doubles.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Intrinsics in pixels, distortion as in `Distortion`.
struct Lens {
  double fx = 1, fy = 1, cx = 0, cy = 0;
  std::vector<double> distortion;
  std::optional<ImageSize> size;

  [[nodiscard]] Eigen::Matrix3d matrix() const;
};

/// Where a camera stands: x = rotation * X + translation has x right, y down, z ahead.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// The view with the matrix K [R | t], evaluated in doubles and then taken as it is: calibrations are not more exact
/// than that, and short numbers are fast ones. Coefficients that are all zero count as no distortion. Throws InputError
/// naming the view if a number is not finite or the matrix is singular.
View make_view(const std::string& name, const Lens& lens, const Pose& pose);

/// The same for a matrix of doubles without distortion.
View make_view(const std::string& name, const Eigen::Matrix<double, 3, 4>& matrix);

/// The pose of a camera-to-world matrix with OpenGL's axes (x right, y up, z back).
Pose from_opengl(const Eigen::Matrix4d& camera_to_world);

/// A camera's matrix as doubles.
Eigen::Matrix<double, 3, 4> to_doubles(const Camera& camera);

}  // namespace nef::visual_hull
