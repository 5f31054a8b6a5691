// SPDX-License-Identifier: Apache-2.0
//
// --proof and --check-proof for paths, and that there is none.
#include "apps/planner/command/runs/runs.h"

#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/no_path/turning_barrier.h"
#include "apps/planner/proofs/make/answer_proof.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/pose_file.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

bool same_poses(const std::vector<RigidPose>& a, const std::vector<RigidPose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const RigidPose& p, const RigidPose& q) {
    return p.position == q.position && p.quaternion == q.quaternion;
  });
}

void write_known(const Arguments& a, const std::optional<PathProof>& proof) {
  if (proof) {
    write_file(a.proof, proof_text(*proof));
  } else {
    std::cerr << "planner: " << a.proof << " was not written, because the path is undecided\n";
  }
}

}  // namespace

void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses,
                      const CertifiedPath& known) {
  if (!a.proof.empty()) write_known(a, make_path_proof(checker, poses, known, a.session.monitor));
}

void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses) {
  if (!a.proof.empty()) write_known(a, make_path_proof(checker, poses, a.session.monitor));
}

void write_translation_proof(const Arguments& a, const Scene& scene, const FreeSpace* free, const Answer& answer,
                             const std::vector<RigidPose>& given) {
  if (a.proof.empty()) return;
  std::string text;
  try {
    text = proof_text(a.tight && given.empty() ? proof_of_tight_passages(scene, *free, a.session.monitor)
                                               : proof_of_answer(scene, free, answer, given, a.session.monitor));
  } catch (const InputError& error) {
    throw InputError("--proof " + a.proof + ": " + error.what());
  }
  write_file(a.proof, text);
}

void write_turning_proof(const Arguments& a, const Scene& scene, const TurningAnswer& answer) {
  if (a.proof.empty()) return;
  if (answer.status == TurningAnswer::Status::kInfeasible) {
    if (const auto proof = make_turning_proof(scene, *answer.proof, a.session.monitor)) {
      write_file(a.proof, proof_text(*proof));
    } else {
      std::cerr << "planner: " << a.proof
                << " was not written: no distance, or only surfaces, separate start and goal, or a barrier takes more "
                << "than 100,000 parts; the report (-o FILE.json) has a proof by cells of angles\n";
    }
    return;
  }
  if (answer.status != TurningAnswer::Status::kPath) {
    std::cerr << "planner: " << a.proof
              << " was not written, because the answer is neither a path nor that there is none\n";
    return;
  }
  if (scene.robot_rotation.linear != AffineMap::identity().linear) {
    throw InputError(
        "--proof: paths of an OMPL.app problem that turn are proved with --path, in poses of the robot's file");
  }
  const TurningAxis axis(scene.rotation->axis);
  std::vector<RigidPose> poses;
  for (const Pose& pose : answer.path) poses.push_back({pose.position, axis.quaternion(pose.turn)});
  const MotionChecker checker = MotionChecker::of_scene(scene, a.session.monitor);
  write_path_proof(a, checker, poses);
}

int tell_check(const Arguments& a, const std::string& title, nlohmann::json found,
               const std::optional<std::string>& complaint, const std::string& what_holds, const Stopwatch& watch) {
  found["holds"] = !complaint;
  if (complaint) found["complaint"] = *complaint;
  const auto print = [&] {
    std::cout << (complaint ? "the proof does not hold: " + *complaint : "the proof holds" + what_holds) << '\n';
  };
  tell(a, {"check_proof", title, [&] { return found; }, {{"op", watch.seconds(), {}}}, print});
  return complaint ? 1 : 0;
}

std::optional<int> run_check_proof(const Arguments& a, const Scene& scene) {
  if (a.check_proof.empty()) return std::nullopt;
  const std::string text = read_file(a.check_proof);
  if (!is_proof_text(text)) return std::nullopt;
  const Stopwatch watch;
  const PathProof proof = parse_proof(text, a.check_proof);
  std::optional<std::string> complaint = complaint_about(proof, a.session.monitor);
  if (!complaint) complaint = complaint_about(proof.claim, scene);
  if (!complaint && !a.given_path.empty() && !same_poses(proof.claim.path, read_path(a.given_path))) {
    complaint = "it is about another path than " + a.given_path;
  }
  const std::string claim = status_word(proof.claim.status);
  return tell_check(a, scene.name, {{"scene", scene.name}, {"claim", claim}}, complaint, ": " + claim, watch);
}

}  // namespace nef::planner
