// SPDX-License-Identifier: Apache-2.0
//
// A path of a rigid body, certified motion by motion.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"

namespace nef::planner {

/// What is known of a path.
struct CertifiedPath {
  /// kFree: proved for every motion. kCollides: for one of them a colliding pose is known, that of the first such
  /// motion. kUndecided: no motion is known to collide, and one at least could not be decided.
  MotionVerdict::Status status = MotionVerdict::Status::kFree;
  std::vector<MotionVerdict>
      motions;  ///< from each pose to the next one; a path of one pose has one motion, which stays
  std::optional<std::size_t> blocked;  ///< kCollides: the first motion that collides
};

/// Certifies all motions of a path of one pose at least. O(motions); see MotionChecker for one. `monitor` is told how
/// many motions are done, and can stop it (Interrupted).
CertifiedPath certify(const MotionChecker& checker, std::span<const RigidPose> poses,
                      MotionTiming timing = MotionTiming::kSlerp, const CheckLimits& limits = {},
                      const Monitor& monitor = {});

/// The robot of a scene as it is in its own file, and the rest of the scene: paths of a .cfg file are about that, while
/// the robot of the Scene is at the orientation of start and goal.
Scene with_robot_as_in_its_file(Scene scene, const Monitor& monitor = {});

/// True if the motion from one pose to another one (MotionTiming::kSlerp) is proved free by what planners spend on a
/// motion (CheckLimits::for_planners). `monitor` can stop it (Interrupted).
bool moves_freely(const MotionChecker& checker, const RigidPose& from, const RigidPose& to, const Monitor& monitor);

}  // namespace nef::planner
