// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions is looked for with the middle of the robot's box as the reference point first, so that turning
// moves the robot as little as can be, then with the middles of its pieces. About one axis, a barrier of poses follows.
#include "apps/planner/no_path/no_rigid_path.h"

#include <algorithm>
#include <utility>

#include "apps/planner/no_path/pose_barrier.h"
#include "apps/planner/no_path/position_barrier.h"
#include "apps/planner/orientation/rotation_claim.h"
#include "apps/planner/rigid/certified_path.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

PathProof::Claim claim_of(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal,
                          const std::vector<Quaternion>& chain) {
  PathProof::Claim claim;
  claim.status = PathProof::Claim::Status::kInfeasible;
  claim.contact = checker.contact();
  claim.box = checker.box();
  for (const RigidBody::Piece& piece : checker.robot().pieces()) claim.robot.push_back(piece.mesh.vertices);
  for (const RigidBody::Piece& piece : checker.obstacles().pieces()) claim.obstacles.push_back(piece.mesh.vertices);
  claim.path = {start, goal};
  claim.rotations = chain;
  return claim;
}

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

// The axis of the rotation from one quaternion to another one, of any length: the vector part of q times p conjugate.
Rational3 axis_between(const Quaternion& p, const Quaternion& q) {
  const Rational3 a{p[1], p[2], p[3]};
  const Rational3 b{q[1], q[2], q[3]};
  const Rational3 c = cross(a, b);
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = p[0] * b[k] - q[0] * a[k] + c[k];
  return result;
}

// The points to try, each once. About one axis, the part of a point along the axis does not matter, and is left out.
std::vector<Rational3> references_of(const PathProof::Claim& claim) {
  constexpr std::size_t kMost = 4;
  Rational3 axis;
  if (!claim.rotations->empty()) axis = axis_between(claim.rotations->at(0), claim.rotations->at(1));
  std::vector<Rational3> all;
  std::vector<Rational3> result;
  const auto add = [&](Rational3 point) {
    const Rational along = is_zero(axis) ? Rational(0) : Rational(dot(point, axis) / dot(axis, axis));
    for (std::size_t k = 0; k < 3; ++k) point[k] -= along * axis[k];
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

NoPathAnswer prove_no_rigid_path(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal,
                                 const std::vector<Quaternion>& chain, const NoPathLimits& limits,
                                 const Monitor& monitor) {
  NoPathAnswer answer;
  PathProof proof;
  proof.claim = claim_of(checker, start, goal, chain);
  const Orientations orientations = chain.empty() ? Orientations::all() : Orientations::along(chain);
  for (const RigidPose* pose : {&start, &goal}) {
    if (!orientations.locate(pose->quaternion)) {
      throw InputError("the orientations of start and goal must be in the chain");
    }
  }
  try {
    const std::vector<Rational3> references = references_of(proof.claim);
    const auto proves = [&](auto&& barrier, std::size_t given) {
      std::size_t budget = given;
      const bool found = barrier.find(budget);
      answer.cells += given - budget;
      answer.in_question = barrier.in_question();
      if (!found) return false;
      proof.cells = barrier.written();
      if (complaint_about(proof, monitor)) return false;
      answer.proof = std::move(proof);
      answer.in_question = 0;
      return true;
    };
    // About one axis, barriers of poses are there where those of positions are not, but take more boxes.
    const bool one_axis = orientations.dimension() == 1;
    const std::size_t for_positions = one_axis ? limits.max_cells / 16 : limits.max_cells;
    for (std::size_t i = 0; i < references.size() && answer.cells < for_positions; ++i) {
      const std::size_t given = (for_positions - answer.cells + 1) / (i + 1 < references.size() ? 2 : 1);
      if (proves(PositionBarrier(proof.claim, orientations, references[i], monitor), given)) return answer;
    }
    if (one_axis && answer.cells < limits.max_cells) {
      proves(PoseBarrier(proof.claim, orientations, references.front(), monitor), limits.max_cells - answer.cells);
    }
  } catch (const Interrupted&) {
    return answer;
  }
  return answer;
}

NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits, const Monitor& monitor) {
  const RotationClaim claim = rotation_claim_of(scene);
  const MotionChecker checker =
      MotionChecker::of_scene(scene.turns_freely ? with_robot_as_in_its_file(scene, monitor) : scene, monitor);
  return prove_no_rigid_path(checker, claim.start, claim.goal, claim.chain, limits, monitor);
}

}  // namespace nef::planner
