// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that translates and turns about all axes has no path.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/proofs/rotation_claim.h"
#include "apps/planner/rigid/motion_checker.h"
#include "nef/base/monitor.h"

namespace nef::planner {

struct NoPathLimits {
  std::size_t max_cells = 200000;  ///< boxes of poses
};

/// Where a barrier may have a hole.
struct BarrierInQuestion {
  Rational3 reference;  ///< the point of the robot whose positions are meant
  /// Boxes of positions, low and high corner, that may not be blocked at all orientations: those of the barrier that
  /// was looked at last.
  std::vector<std::array<std::array<double, 3>, 2>> boxes;
};

/// What was found.
struct NoPathAnswer {
  /// The proof; nothing if it is undecided whether there is a path.
  std::optional<PathProof> proof;
  std::size_t cells = 0;  ///< boxes of poses that were made
  /// Without a proof: a measure of what a barrier takes all of which seems to be blocked. The deeper pieces overlap on
  /// it, the less. It tells scenes that have a proof from others (14 to 24 in those that were looked at, and 900 to
  /// 1,700 or nothing), not how many boxes it takes.
  std::optional<std::size_t> cells_left;
  BarrierInQuestion in_question;  ///< without a proof
};

/// The claim that a robot among obstacles has no path.
PathProof::Claim no_path_claim(const MotionChecker& checker, const RotationClaim& meant);

/// Looks for a proof that every path from `start` to `goal` collides, of translations and all rotations. Robot,
/// obstacles, box and contact rule are the checker's. Both poses must be free, or there is no proof. A search that has
/// come to its limits can go on.
///
/// The proof is a barrier of positions that a point of the robot, the middle of the robot or of one of its pieces,
/// cannot take, however the robot is turned (PositionBarrier). If there is such a barrier of some thickness, each pose
/// on it is blocked by one pair of solid pieces, and the limits are wide enough, it is found; where the robot must be
/// turned to pass, and cannot, but each of its points could be anywhere, there is none. How many boxes it takes grows
/// steeply as the robot becomes nearly small enough to pass. Everything is found in doubles; a proof is returned only
/// if complaint_about has nothing against it. Ends without a proof if the limits are
/// reached, the monitor stops it, or nothing is left to be cut.
class NoPathSearch {
 public:
  NoPathSearch(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal);
  ~NoPathSearch();

  /// Goes on until the proof is found, `max_cells` boxes are made in all, nothing is left to be cut, or the monitor
  /// stops it.
  NoPathAnswer run(std::size_t max_cells, const Monitor& monitor = {});

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// One such search, for the question of a scene whose robot turns freely (rigid_question_of).
NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits = {}, const Monitor& monitor = {});

}  // namespace nef::planner
