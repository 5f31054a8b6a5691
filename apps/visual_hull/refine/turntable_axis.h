// SPDX-License-Identifier: Apache-2.0
//
// Whether cameras are those of a turntable, and about which axis it turns.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "apps/visual_hull/refine/moving_camera.h"

namespace nef::visual_hull::refine {

/// A line in space.
struct Axis {
  Eigen::Vector3d point, direction;
};

/// The axis of a turntable before one camera: all cameras are one camera, up to `angle` (radians) and `share` (of the
/// distance), that the object's turns about the axis have moved. Nothing if they are not, or are fewer than five.
std::optional<Axis> turntable_axis(const std::vector<MovingCamera>& cameras, double angle, double share);

/// The same cameras, each moved as little as it takes to be one camera that turns about the axis (least squares); with
/// `even`, by equal angles from view to view. Nothing if angles are to be even and are not, up to two degrees. The
/// focal lengths stay as they are.
std::optional<std::vector<MovingCamera>> as_turntable(const std::vector<MovingCamera>& cameras, const Axis& axis,
                                                      bool even);

}  // namespace nef::visual_hull::refine
