// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that translates and turns about all axes has no path.
#pragma once

#include <cstddef>
#include <optional>

#include "apps/planner/orientation/rotation_claim.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/rigid/motion_checker.h"
#include "nef/base/monitor.h"

namespace nef::planner {

struct NoPathLimits {
  std::size_t max_cells = 50000;  ///< boxes of poses
};

/// What was found.
struct NoPathAnswer {
  /// The proof; nothing if it is undecided whether there is a path.
  std::optional<PathProof> proof;
  std::size_t cells = 0;        ///< boxes of poses that were made
  std::size_t in_question = 0;  ///< without a proof: boxes of positions that may not be blocked, in the last barrier
};

/// The claim that a robot among obstacles has no path.
PathProof::Claim no_path_claim(const MotionChecker& checker, const RotationClaim& meant);

/// Looks for a proof that every path from `start` to `goal` collides, of translations and all rotations. Robot,
/// obstacles, box and contact rule are the checker's. Both poses must be free, or there is no proof.
///
/// The proof is a barrier of positions that a point of the robot, the middle of the robot or of one of its pieces,
/// cannot take, however the robot is turned (PositionBarrier). If there is such a barrier of some thickness, each pose
/// on it is blocked by one pair of solid pieces, and the limits are wide enough, it is found; where the robot must be
/// turned to pass, and cannot, but each of its points could be anywhere, there is none. How many boxes it takes grows
/// steeply as the robot becomes nearly small enough to pass. Everything is found in doubles; a proof is returned only
/// if complaint_about has nothing against it. Ends without a proof if the limits are
/// reached, the monitor stops it, or nothing is left to be cut.
NoPathAnswer prove_no_rigid_path(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal,
                                 const NoPathLimits& limits = {}, const Monitor& monitor = {});

/// The same for the question of a scene whose robot turns freely (rigid_question_of).
NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits = {}, const Monitor& monitor = {});

}  // namespace nef::planner
