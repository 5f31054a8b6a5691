// SPDX-License-Identifier: Apache-2.0
//
// Certified collision checks of rigid bodies: whole motions instead of samples on them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/rigid/motion_cell.h"
#include "apps/planner/rigid/rigid_body.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What is known of a motion.
struct MotionVerdict {
  enum class Status : std::uint8_t {
    kFree,      ///< proved: no pose of the motion collides
    kCollides,  ///< a pose of the motion collides, exactly
    kUndecided  ///< neither was proved within the limits; contact while turning is the usual cause
  };
  Status status = Status::kFree;
  /// kFree: bodies touch, or come closer than doubles can tell, so the motion may be free only because contact is
  /// allowed. False means that there is a gap everywhere.
  bool touches = false;
  /// kCollides: a colliding pose, the parameter of the motion at which it is (rounded, if the motion does not turn),
  /// and the pieces that overlap there.
  std::optional<RigidPose> pose;
  double parameter = 0;
  std::uint32_t robot_piece = 0;
  std::uint32_t obstacle_piece = 0;
  /// Parts of the motion that are not decided, in order.
  std::vector<std::array<double, 2>> undecided;
  /// The motion is proved free up to this parameter. Meaningful if it was asked for (CheckLimits::in_order).
  double free_until = 1;
  /// kFree: in each of these parts, in order, all pairs of pieces are apart as MotionCells encloses them. Empty unless
  /// it was asked for (CheckLimits::keep_parts).
  std::vector<std::array<double, 2>> parts;
  std::size_t cells = 0;  ///< parts of the motion that were looked at
};

/// The word of reports: "path", "blocked" or "undecided".
const char* status_name(MotionVerdict::Status status);

/// How long a motion is examined.
struct CheckLimits {
  unsigned depth = 20;           ///< parts are halved so many times at most, at most 40
  std::size_t max_cells = 4096;  ///< parts that are looked at
  std::size_t max_exact = 64;    ///< exact tests of about a millisecond each, beside those of the ends
  /// Examine parts in the order of time and stop at the first one that is not free, so that free_until is meaningful.
  /// The default order finds collisions sooner.
  bool in_order = false;
  bool keep_parts = false;  ///< fill MotionVerdict::parts
  bool keep_pose = true;    ///< fill MotionVerdict::pose, which takes exact numbers
  /// Surfaces collide with what they touch. Else, where contact is allowed, they collide with what has them inside of
  /// one of its pieces; surfaces between its pieces are for the caller.
  bool surfaces_block = true;

  /// Fewer parts: planners reject what takes long.
  [[nodiscard]] static CheckLimits for_planners() {
    CheckLimits limits;
    limits.depth = 12;
    limits.max_cells = 1024;
    return limits;
  }
};

/// Answers whether poses and motions of a rigid robot among rigid obstacles collide. Contact rule: with kAllow two
/// solids collide where their interiors overlap, with kForbid where they have a common point. A surface, and whatever
/// else has no inside, collides with everything that it touches, under either rule. Positions must lie in the box, if
/// there is one.
///
/// A motion is cut into parts until in each of them trees of boxes, and then planes between the hulls that enclose what
/// pieces sweep (motion_cell.h), keep robot and obstacles apart; pairs that are not apart are handed down to both
/// halves. Doubles decide with proven bounds, and exact numbers decide contact. The cost grows with the number of pairs
/// that come close, and with the inverse of the clearance.
///
/// Const and safe to share between threads.
class MotionChecker {
 public:
  /// A robot among obstacles, and the box for its reference point, if there is one.
  MotionChecker(RigidBody robot, RigidBody obstacles, ContactRule contact = ContactRule::kAllow,
                std::optional<std::array<Rational3, 2>> box = std::nullopt);

  /// The robot and the obstacles of a scene, without its rotation, start and goal. Obstacles may be unbounded if the
  /// scene has a box. Throws InputError as RigidBody::of_set does.
  static MotionChecker of_scene(const Scene& scene, const Monitor& monitor = {});

  /// Exact. For a collision the verdict says where; it is never kUndecided. `monitor` can stop it (Interrupted).
  [[nodiscard]] MotionVerdict check(const RigidPose& pose, const CheckLimits& limits = {},
                                    const Monitor& monitor = {}) const;
  /// Never wrong; kUndecided if the limits are reached. Both ends are checked exactly, unless the motion is decided
  /// before. `monitor` can stop it (Interrupted).
  [[nodiscard]] MotionVerdict check(const RigidMotion& motion, const CheckLimits& limits = {},
                                    const Monitor& monitor = {}) const;

  /// What it was made of.
  /// @{
  [[nodiscard]] const RigidBody& robot() const { return robot_; }
  [[nodiscard]] const RigidBody& obstacles() const { return obstacles_; }
  [[nodiscard]] ContactRule contact() const { return contact_; }
  [[nodiscard]] const std::optional<std::array<Rational3, 2>>& box() const { return box_; }
  /// @}
  /// Whether the box, if there is one, holds a position.
  [[nodiscard]] bool in_box(const Rational3& position) const { return is_in_box(position, box_); }

 private:
  friend class MotionExamination;

  RigidBody robot_;
  RigidBody obstacles_;
  std::vector<RoughPolytope> rough_obstacles_;  // of each piece
  ContactRule contact_;
  std::optional<std::array<Rational3, 2>> box_;
};

}  // namespace nef::planner
