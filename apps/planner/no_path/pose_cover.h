// SPDX-License-Identifier: Apache-2.0
//
// Are all poses of boxes of positions blocked, however the robot is turned?
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

/// Whether a pair overlaps at all positions of the hull of some corners, at the orientations for which the robot is
/// turned. Then there is a point of both pieces for each corner.
std::vector<Rational3> common_points(const BlockingPairs& pairs, const BlockingPairs::Pair& pair,
                                     const TurnedRobot& robot, std::span<const Vector3d> corners);

/// A box of positions all of whose poses are to be blocked.
struct CoverTask {
  PositionBox box;
  std::vector<PathProof::PoseCell>* charts;  ///< becomes the boxes of poses, for each chart
};

/// What came of covering boxes of positions.
struct PoseCover {
  std::vector<bool> is_done;     ///< of each box: all poses are blocked
  std::optional<OpenPose> open;  ///< one that is not; neither: the budget is used up
  std::size_t open_task = 0;     ///< the box that has it
};

/// Cuts boxes of positions and all orientations until each part is blocked by one pair of pieces or beyond a side of
/// the claim's box, the first box first; of the others only as many parts as fill the threads. Stops when a part is
/// found in the middle of which no pair overlaps. `budget` is how many parts may be made, and becomes what is left of
/// it; if that is nothing, another call with the same charts goes on. The result depends on none but the arguments, and
/// not on the number of threads. A part takes some ten small programs for each pair that may meet in it; a chart that
/// is the image of another one takes none.
PoseCover cover_poses(const BlockingPairs& pairs, const Orientations& orientations,
                      const std::vector<std::optional<ChartImage>>& images, std::span<const CoverTask> tasks,
                      std::size_t& budget, const Monitor& monitor = {});

}  // namespace nef::planner
