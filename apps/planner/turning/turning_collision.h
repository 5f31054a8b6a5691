// SPDX-License-Identifier: Apache-2.0
//
// One pose or motion of a robot that turns, checked without any free space.
#pragma once

#include <vector>

#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/turning/turning_question.h"

namespace nef::planner {

/// Is a pose free, is a motion? With the bodies, trees and filters of a MotionChecker, but by the contact rule of
/// scenes, under which the robot, a solid, may slide on surfaces; and a motion at one angle is always decided. Const
/// and safe to share between threads.
class TurningCollision {
 public:
  /// Throws InputError unless the robot is a bounded solid and the obstacles are bounded or the scene has a box.
  TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor = {});

  [[nodiscard]] const TurningAxis& axis() const { return axis_; }
  /// Exact.
  [[nodiscard]] bool is_free(const Pose& pose) const { return is_free(pose, pose); }
  /// From pose to pose, straight, while the angle goes evenly. Exact if the angle stays. Else true only if all is
  /// surely free: the motion is halved up to `depth` times. The angles must be less than a half turn apart.
  [[nodiscard]] bool is_free(const Pose& from, const Pose& to, int depth = 12) const;

 private:
  [[nodiscard]] RigidPose rigid(const Pose& pose) const { return {pose.position, axis_.quaternion(pose.turn)}; }
  // A motion that does not turn, in which no pairs of nodes but these come close.
  [[nodiscard]] bool is_free_straight(const RigidMotion& motion, const std::vector<NodePair>& pairs) const;
  // Whether two pieces surely overlap at some pose of it.
  [[nodiscard]] static bool surely_hits(const MotionCells& cells, const RigidBody::Piece& a, const RigidBody::Piece& b);
  // By sets: does the inside of the robot meet what is flat on its way?
  [[nodiscard]] bool meets_flat(const RigidBody::Piece& flat, const RigidMotion& motion) const;
  [[nodiscard]] bool surely_free(const MotionCells& cells, double from, double to, std::vector<NodePair> pairs,
                                 int depth) const;

  Polyhedron robot_;
  TurningAxis axis_;
  MotionChecker bodies_;
  bool closed_;  // contact is a collision
};

}  // namespace nef::planner
