// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that turns has no path, for .proof files and as an answer.
#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs.h"
#include "apps/planner/orientation/no_rigid_path.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid/certified_path.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

NoPathLimits no_path_limits(const Arguments& a) {
  NoPathLimits limits;
  if (a.app->count("--max-cells") > 0) limits.max_cells = a.max_cells;
  return limits;
}

}  // namespace

std::optional<int> run_no_path(const Arguments& a, const Scene& scene) {
  const TimeLimit limit(a.time, a.session.monitor);
  const NoPathAnswer answer = prove_no_rigid_path(scene, no_path_limits(a), limit.monitor());
  if (!answer.proof) return std::nullopt;
  if (!a.proof.empty()) write_file(a.proof, proof_text(*answer.proof));
  const auto report = [&] {
    return nlohmann::json{{"scene", scene.name},
                          {"status", "infeasible"},
                          {"motions", "rigid"},
                          {"contact", scene.contact == ContactRule::kAllow ? "allow" : "forbid"},
                          {"boxes", answer.cells}};
  };
  const auto print = [&] {
    std::cout << "infeasible at every orientation, " << counted(answer.cells, "box", "boxes") << " of poses\n";
  };
  tell(a, {"rigid", scene.name, report, {{"op", limit.passed(), {}}}, print});
  return 1;
}

void write_turning_proof(const Arguments& a, const Scene& scene, const TurningAnswer& answer) {
  if (a.proof.empty()) return;
  if (answer.status == TurningAnswer::Status::kInfeasible) {
    const NoPathAnswer found = prove_no_rigid_path(scene, no_path_limits(a), a.session.monitor);
    if (found.proof) {
      write_file(a.proof, proof_text(*found.proof));
    } else {
      std::cerr << "planner: " << a.proof
                << " was not written: no point of the robot shows by its positions alone that "
                << "there is no path; the report (-o FILE.json) has a proof by cells of angles\n";
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
  CheckLimits limits;
  limits.keep_parts = true;
  write_path_proof(a, checker, poses, certify(checker, poses, MotionTiming::kSlerp, limits));
}

}  // namespace nef::planner
