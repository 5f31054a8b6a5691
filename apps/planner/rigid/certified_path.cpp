// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/certified_path.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::planner {

CertifiedPath certify(const MotionChecker& checker, std::span<const RigidPose> poses, MotionTiming timing,
                      const CheckLimits& limits, const Monitor& monitor) {
  using Status = MotionVerdict::Status;
  if (poses.empty()) throw InputError("a path needs one pose at least");
  CertifiedPath result;
  const std::size_t motions = std::max<std::size_t>(poses.size() - 1, 1);
  result.motions.resize(motions);
  parallel_for(motions, monitor, [&](std::size_t i, const Monitor& own) {
    own.tell_progress("certifying motions", i, motions);
    const RigidPose& to = poses[std::min(i + 1, poses.size() - 1)];
    result.motions[i] = checker.check(RigidMotion(poses[i], to, timing), limits, own);
  });
  for (std::size_t i = 0; i < motions; ++i) {
    const Status status = result.motions[i].status;
    if (status == Status::kCollides && !result.blocked) result.blocked = i;
    if (status == Status::kUndecided && result.status == Status::kFree) result.status = Status::kUndecided;
  }
  if (result.blocked) result.status = Status::kCollides;
  return result;
}

Scene with_robot_as_in_its_file(Scene scene, const Monitor& monitor) {
  AffineMap back = AffineMap::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) back.linear[i][j] = scene.robot_rotation.linear[j][i];  // orthogonal
  }
  scene.robot = transform(scene.robot, back, monitor);
  scene.robot_rotation = AffineMap::identity();
  return scene;
}

bool moves_freely(const MotionChecker& checker, const RigidPose& from, const RigidPose& to, const Monitor& monitor) {
  CheckLimits limits = CheckLimits::for_planners();
  limits.keep_pose = false;
  const MotionVerdict verdict = checker.check(RigidMotion(from, to, MotionTiming::kSlerp), limits, monitor);
  return verdict.status == MotionVerdict::Status::kFree;
}

}  // namespace nef::planner
