// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions is looked for with the middle of the robot's box as the reference point first, so that turning
// moves the robot as little as can be, then with the middles of its pieces.
#include "apps/planner/no_path/no_rigid_path.h"

#include <algorithm>
#include <utility>

#include "apps/planner/no_path/position_barrier.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/rigid_question.h"
#include "nef/base/interruption.h"

namespace nef::planner {
namespace {

// The middle of the box around some points.
Rational3 middle_of(const std::vector<Rational3>& points) {
  Rational3 low = points.front();
  Rational3 high = low;
  for (const Rational3& v : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], v[k]);
      high[k] = std::max(high[k], v[k]);
    }
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

// The points to try, each once.
std::vector<Rational3> references_of(const PathProof::Claim& claim) {
  constexpr std::size_t kMost = 4;
  std::vector<Rational3> all;
  std::vector<Rational3> result;
  const auto add = [&](const Rational3& point) {
    if (result.size() < kMost && std::find(result.begin(), result.end(), point) == result.end()) {
      result.push_back(point);
    }
  };
  for (const std::vector<Rational3>& piece : claim.robot) all.insert(all.end(), piece.begin(), piece.end());
  add(middle_of(all));
  for (const std::vector<Rational3>& piece : claim.robot) add(middle_of(piece));
  return result;
}

}  // namespace

PathProof::Claim no_path_claim(const MotionChecker& checker, const RotationClaim& meant) {
  PathProof::Claim claim;
  claim.status = PathProof::Claim::Status::kInfeasible;
  claim.contact = checker.contact();
  claim.box = checker.box();
  for (const RigidBody::Piece& piece : checker.robot().pieces()) claim.robot.push_back(piece.mesh.vertices);
  for (const RigidBody::Piece& piece : checker.obstacles().pieces()) claim.obstacles.push_back(piece.mesh.vertices);
  claim.path = {meant.start, meant.goal};
  claim.rotations = meant.chain;
  claim.places = meant.places;
  return claim;
}

NoPathAnswer prove_no_rigid_path(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal,
                                 const NoPathLimits& limits, const Monitor& monitor) {
  NoPathAnswer answer;
  PathProof proof;
  proof.claim = no_path_claim(checker, {start, goal, {}, {}, {}});
  const Orientations orientations = Orientations::all();
  try {
    const std::vector<Rational3> references = references_of(proof.claim);
    for (std::size_t i = 0; i < references.size() && answer.cells < limits.max_cells; ++i) {
      const std::size_t given = (limits.max_cells - answer.cells + 1) / (i + 1 < references.size() ? 2 : 1);
      std::size_t budget = given;
      PositionBarrier barrier(proof.claim, orientations, references[i], monitor);
      const bool found = barrier.find(budget);
      answer.cells += given - budget;
      answer.in_question = barrier.in_question();
      if (!found) continue;
      proof.cells = barrier.written();
      if (complaint_about(proof, monitor)) continue;
      answer.proof = std::move(proof);
      answer.in_question = 0;
      return answer;
    }
  } catch (const Interrupted&) {
    return answer;
  }
  return answer;
}

NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits, const Monitor& monitor) {
  const RigidQuestion question = rigid_question_of(scene);
  return prove_no_rigid_path(MotionChecker::of_scene(with_robot_as_in_its_file(scene, monitor), monitor),
                             question.start, question.goal, limits, monitor);
}

}  // namespace nef::planner
