// SPDX-License-Identifier: Apache-2.0
//
// Paths of a rigid body that translates and turns about all axes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/planner/no_path/no_rigid_path.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/rigid_question.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// How far a search goes.
struct RigidLimits {
  std::size_t max_slices = 2000;                     ///< exact free spaces at rotations
  std::size_t max_samples = 32000;                   ///< random poses
  std::size_t max_boxes = NoPathLimits().max_cells;  ///< boxes of poses in a proof that there is no path

  /// With another number of slices, and of the others in proportion; without a number there are no limits if the time
  /// is limited.
  static RigidLimits of(std::optional<std::size_t> max_slices, bool time_is_limited);
};

/// How much random poses and slices do in a turn of find_rigid_path.
struct RigidTurn {
  std::size_t samples = 0;
  std::size_t slices = 0;

  /// `size`: 1 for the first turn, twice as much for each one after it. Of scenes with many pieces fewer slices are
  /// made, as they take longer, or none, and more random poses are drawn.
  static RigidTurn of(const MotionChecker& checker, std::size_t size = 1);
};

/// What is known of a question about a rigid body.
struct RigidAnswer {
  using Status = AnswerStatus;  ///< kPath, kInfeasible, kInvalidStart, kInvalidGoal or kUndecided
  Status status = Status::kUndecided;
  /// kPath: way-points from start to goal. Between two the position goes straight and the rotation along the shorter
  /// arc, at constant speed (MotionTiming::kSlerp).
  std::vector<RigidPose> path;
  /// kPath: the proof of each motion.
  CertifiedPath certified;
  /// kInfeasible: the proof that every path collides, however the robot turns (no_rigid_path.h). It has been checked.
  std::optional<PathProof> proof;
  /// kInvalidStart, kInvalidGoal: what the robot hits there. Nothing if it only touches a surface.
  std::optional<Collision> collision;
  std::size_t samples = 0;  ///< random poses that were drawn
  std::size_t slices = 0;   ///< exact free spaces that were computed
  std::size_t boxes = 0;    ///< boxes of poses that were made to prove that there is no path
  /// kUndecided: where the barrier that a proof would need may have a hole.
  BarrierInQuestion in_question;
};

/// The answer if the start or the goal is not free, else nothing. `checker` must be that of the scene.
std::optional<RigidAnswer> invalid_rigid_end(const Scene& scene, const MotionChecker& checker,
                                             const Monitor& monitor = {});

/// Searches in turns by random poses (certified_trees.h), which is quick where there is room, through exact slices
/// (slice_search.h), which finds narrow places, and for a proof that there is no path (no_rigid_path.h). Every motion
/// is certified, and checked once more before the path is returned. A search that ends with neither proves nothing: the
/// answer is kUndecided then, and when the monitor stops it. The answer is the same in every run unless it is stopped.
/// `checker` must be that of the scene. Throws InputError unless the scene's robot turns freely and has a start and a
/// goal.
RigidAnswer find_rigid_path(const Scene& scene, const MotionChecker& checker, const RigidLimits& limits = {},
                            const Monitor& monitor = {});

}  // namespace nef::planner
