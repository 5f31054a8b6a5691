// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that translates and turns has no path.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

/// Looks for a proof that every path from `start` to `goal` collides, of translations and the given rotations: all of
/// them, if `chain` is empty, or those along the arcs from each quaternion of the chain to the next one; both
/// quaternions must be in the chain then, or be multiples of those that are. Robot, obstacles, box and contact rule are
/// the checker's. Both poses must be free, or there is no proof.
///
/// The proof is a barrier of positions that a point of the robot, the middle of the robot or of one of its pieces,
/// cannot take, however the robot is turned (PositionBarrier). If there is such a barrier of some thickness, each pose
/// on it is blocked by one pair of solid pieces, and the limits are wide enough, it is found; where the robot must be
/// turned to pass, and cannot, but each of its points could be anywhere, there is none. About one axis there is one,
/// too: a barrier of positions and angles (PoseBarrier). How many boxes it takes grows steeply as the robot becomes
/// nearly small enough to pass. Everything is found in doubles; a proof is returned only
/// if complaint_about has nothing against it, which takes most of the time. Ends without a proof if the limits are
/// reached, the monitor stops it, or nothing is left to be cut. Throws InputError if the chain is not one.
NoPathAnswer prove_no_rigid_path(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal,
                                 const std::vector<Quaternion>& chain, const NoPathLimits& limits = {},
                                 const Monitor& monitor = {});

/// The same for the question of a scene.
NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits = {}, const Monitor& monitor = {});

}  // namespace nef::planner
