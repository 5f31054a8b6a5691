// SPDX-License-Identifier: Apache-2.0
//
// Boxes in any direction around points.
#pragma once

#include <vector>

#include "apps/planner/intersection/vectors.h"

namespace nef::planner {

/// The points centre + axes x with |x_k| <= half_k. Axes are columns.
struct OrientedBox {
  /// Axes are orthonormal up to this: no entry of A^T A is farther from the unit matrix's.
  static constexpr double kSkew = 0x1p-46;

  Vector3d centre = Vector3d::Zero();
  Vector3d half = Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// An eighth of the area of its surface, by which boxes around the same points compare.
  [[nodiscard]] double size() const { return half[0] * half[1] + half[1] * half[2] + half[2] * half[0]; }
};

/// The box with given axes around points that were rounded to the nearest doubles: it holds what was rounded. There
/// must be a point. Axes that are not orthonormal up to OrientedBox::kSkew are replaced by those of the coordinates.
OrientedBox box_around(const std::vector<Vector3d>& points, const Eigen::Matrix3d& axes);

/// Axes along which points scatter most and least.
Eigen::Matrix3d axes_of_scatter(const std::vector<Vector3d>& points);

/// Axes along a unit normal and, across it, the longest way from one point to the next.
Eigen::Matrix3d axes_of_polygon(const std::vector<Vector3d>& points, const Vector3d& normal);

}  // namespace nef::planner
