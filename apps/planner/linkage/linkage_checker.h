// SPDX-License-Identifier: Apache-2.0
//
// Certified collision checks of linkages: whole motions of their joints instead of samples on them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/planner/linkage/link_chain.h"
#include "apps/planner/linkage/linkage.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

/// What is known of a motion of a linkage.
struct LinkageVerdict {
  /// kFree: proved, with a gap everywhere. kCollides: at a parameter two bodies surely overlap, or a surface is surely
  /// crossed. kUndecided: neither was proved; contact, and what comes nearer than doubles can tell, always is.
  MotionVerdict::Status status = MotionVerdict::Status::kFree;
  double parameter = 0;              ///< kCollides: where
  std::size_t link = 0;              ///< kCollides: which link ...
  std::optional<std::size_t> other;  ///< ... and which other one; nothing for an obstacle
  /// The motion is proved free up to this parameter. Meaningful if it was asked for (CheckLimits::in_order).
  double free_until = 1;
  std::vector<std::array<double, 2>> undecided;  ///< parts that are not decided
  std::size_t cells = 0;                         ///< parts that were looked at
};

/// Answers whether a linkage collides with obstacles that stay, or with itself, while all joints go evenly from values
/// to values, as ompl::base::RealVectorStateSpace interpolates. Joints' angles are transcendental, so contact is not
/// decided: what is told is what holds with a gap, or with an overlap, that exceeds the proven bound of rounding.
///
/// Each pair of links, and each link with the obstacles, is a rigid body that moves as its chain of joints does
/// (link_chain.h), and is cut in parts as by MotionChecker. The first link and what is fixed to it stays, so it is not
/// compared with the obstacles. Const and safe to share between threads.
class LinkageChecker {
 public:
  /// `obstacles` may have no pieces. Throws InputError as require_valid does.
  LinkageChecker(Linkage linkage, RigidBody obstacles);

  /// Limits mean what they do for MotionChecker; max_exact and keep_parts do nothing. There must be a value for each
  /// joint. O(pairs) poses, and for each part of a pair what comes close. `monitor` can stop it (Interrupted).
  [[nodiscard]] LinkageVerdict check(std::span<const double> from, std::span<const double> to,
                                     const CheckLimits& limits = {}, const Monitor& monitor = {}) const;
  /// Joints that stay.
  [[nodiscard]] LinkageVerdict check(std::span<const double> values) const;

  /// What is checked.
  [[nodiscard]] const Linkage& linkage() const { return linkage_; }

 private:
  friend class LinkageExamination;
  // Two bodies that are compared: a link, and another one before it, or the obstacles.
  struct Compared {
    LinkChain chain;
    std::size_t link;
    std::optional<std::size_t> other;
    double reach;  // of the link
  };
  [[nodiscard]] const RigidBody& moving(const Compared& two) const { return *linkage_.links[two.link].body; }
  [[nodiscard]] const RigidBody& still(const Compared& two) const {
    return two.other ? *linkage_.links[*two.other].body : obstacles_;
  }
  void compare(std::size_t link, std::optional<std::size_t> other);

  Linkage linkage_;
  RigidBody obstacles_;
  std::vector<Compared> compared_;
};

}  // namespace nef::planner
