// SPDX-License-Identifier: Apache-2.0
//
// Proofs of translations are those of a rigid path whose poses are not turned.
#include "apps/planner/proofs/answer_proof.h"

#include "nef/base/error.h"

namespace nef::planner {
namespace {

// The path that an answer is about; no poses if the answer is about something else.
std::vector<RigidPose> poses_about(const Scene& scene, const Answer& answer, std::span<const RigidPose> given) {
  switch (answer.status) {
    case Answer::Status::kPath:
      return poses_at(answer.path->points);
    case Answer::Status::kBlocked:
      return {given.begin(), given.end()};
    case Answer::Status::kInvalidStart:
      return poses_at({*scene.start});
    case Answer::Status::kInvalidGoal:
      return poses_at({*scene.goal});
    default:
      return {};
  }
}

}  // namespace

std::vector<RigidPose> poses_at(const std::vector<Rational3>& positions) {
  std::vector<RigidPose> poses;
  for (const Rational3& position : positions) poses.push_back({position, {1, 0, 0, 0}});
  return poses;
}

PathProof proof_of_answer(const Scene& scene, const FreeSpace* free, const Answer& answer,
                          std::span<const RigidPose> given, const Monitor& monitor) {
  if (answer.status == Answer::Status::kInfeasible) {
    if (auto proof = make_barrier_proof(scene, free->set(), *scene.start, *scene.goal, monitor)) return *proof;
    throw InputError("no barrier of solid pieces separates start and goal by a distance");
  }
  if (answer.status == Answer::Status::kUndecided) throw InputError("there is no answer to prove: it is undecided");
  const std::vector<RigidPose> poses = poses_about(scene, answer, given);
  if (poses.empty()) throw InputError("the scene has no start and goal; add them");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  CheckLimits limits;
  limits.keep_parts = true;
  const CertifiedPath known = certify(checker, poses, MotionTiming::kSlerp, limits);
  const bool is_path = answer.status == Answer::Status::kPath;
  std::optional<PathProof> proof;
  if (known.status == (is_path ? MotionVerdict::Status::kFree : MotionVerdict::Status::kCollides)) {
    proof = make_path_proof(checker, poses, known);
  }
  if (!proof) {
    throw InputError("robot and obstacles touch at a surface, and proofs cannot state contacts with surfaces");
  }
  return *proof;
}

}  // namespace nef::planner
