// SPDX-License-Identifier: Apache-2.0
//
// Shorter paths of rigid bodies.
#pragma once

#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A path with the same ends that is no longer: poses are left out, and corners cut, where the new motions are
/// certified for MotionTiming::kSlerp. The length is that of a PoseMetric with the reach of the robot. Some hundred
/// motions are checked; when the monitor stops it, the path is as short as it has become by then.
std::vector<RigidPose> shorten(const MotionChecker& checker, std::vector<RigidPose> path, const Monitor& monitor = {});

}  // namespace nef::planner
