// SPDX-License-Identifier: Apache-2.0
//
// Are all poses of a box of positions blocked, however the robot is turned?
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/chart_images.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A pose at which nothing seems to block the robot.
struct OpenPose {
  Vector3d position{0, 0, 0};
  OrientationBox<double> orientation;  ///< of one point
};

/// What is known of a box of positions: boxes of poses for each chart that are all blocked, or a pose that is not.
struct PoseCover {
  std::vector<PathProof::PoseCell> charts;
  std::optional<OpenPose> open;
};

/// Whether a pair overlaps at all positions of the hull of some corners, at the orientations for which the robot is
/// turned. Then there is a point of both pieces for each corner.
std::vector<Rational3> common_points(const BlockingPairs& pairs, const BlockingPairs::Pair& pair,
                                     const TurnedRobot& robot, std::span<const Vector3d> corners);

/// Cuts a box of positions and all orientations until each part is blocked by one pair of pieces or beyond a side of
/// the box. Stops at the first part in the middle of which no pair overlaps. `budget` is how many parts may be made,
/// and becomes what is left of it; if that is nothing, the middle of the part in question counts as open. A part takes
/// some ten small programs for each pair that may meet in it; a chart that is the image of another one takes none.
PoseCover cover_poses(const BlockingPairs& pairs, const Orientations& orientations,
                      const std::vector<std::optional<ChartImage>>& images, const PositionBox& box, std::size_t& budget,
                      const Monitor& monitor = {});

}  // namespace nef::planner
