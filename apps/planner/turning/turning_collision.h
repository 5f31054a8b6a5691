// SPDX-License-Identifier: Apache-2.0
//
// One pose or motion of a robot that turns, checked without any free space.
#pragma once

#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/turning/turning_question.h"

namespace nef::planner {

/// Is a pose free, is a motion? Answers of a MotionChecker, by the contact rule of scenes, under which the robot, a
/// solid, may slide on surfaces; and a motion at one angle is always decided. Const and safe to share between threads.
class TurningCollision {
 public:
  /// Throws InputError unless the robot is a bounded solid and the obstacles are bounded or the scene has a box.
  TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor = {});

  [[nodiscard]] const TurningAxis& axis() const { return axis_; }
  /// Exact.
  [[nodiscard]] bool is_free(const Pose& pose) const;
  /// From pose to pose, straight, while the angle goes evenly. Exact if the angle stays. Else true only if all is
  /// surely free: the motion is halved up to `depth` times. The angles must be less than a half turn apart.
  [[nodiscard]] bool is_free(const Pose& from, const Pose& to, unsigned depth = 12) const;

 private:
  [[nodiscard]] RigidPose rigid(const Pose& pose) const { return {pose.position, axis_.quaternion(pose.turn)}; }
  // By sets: does the inside of the robot meet a surface between its pieces, on a way at one angle?
  [[nodiscard]] bool meets_surface(const RigidMotion& motion) const;

  Polyhedron robot_;
  TurningAxis axis_;
  MotionChecker bodies_;
  bool seams_;  // surfaces may be inside the robot, and inside none of its pieces
};

}  // namespace nef::planner
