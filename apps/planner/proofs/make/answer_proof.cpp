// SPDX-License-Identifier: Apache-2.0
//
// Proofs of translations are those of a rigid path whose poses are not turned.
#include "apps/planner/proofs/make/answer_proof.h"

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
  const MotionChecker checker = MotionChecker::of_scene(scene, monitor);
  const bool is_path = answer.status == Answer::Status::kPath;
  const auto claimed = is_path ? PathProof::Claim::Status::kFree : PathProof::Claim::Status::kBlocked;
  std::optional<PathProof> proof = make_path_proof(checker, poses, monitor);
  if (!proof || proof->claim.status != claimed) {
    throw InputError("robot and obstacles touch at a surface, and proofs cannot state contacts with surfaces");
  }
  return *proof;
}

PathProof proof_of_tight_passages(const Scene& scene, const FreeSpace& free, const Monitor& monitor) {
  if (free.passages().empty()) throw InputError("no passage is tight, so there is nothing to prove");
  free.build_roadmap(monitor);
  if (auto proof = make_tight_proof(scene, free, monitor)) return *proof;
  throw InputError("the contacts in one of the passages do not show by themselves that it is tight");
}

}  // namespace nef::planner
