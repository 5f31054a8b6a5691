// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/runs.h"

#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {
namespace {

using nlohmann::json;

const char* status_text(MotionVerdict::Status status) {
  return std::array{"path", "blocked", "undecided"}.at(static_cast<std::size_t>(status));
}

json pose_json(const RigidPose& pose) {
  json quaternion = json::array();
  for (const Rational& x : pose.quaternion) quaternion.push_back(to_string(x));
  return {{"position", exact_json(pose.position)}, {"quaternion", std::move(quaternion)}};
}

json motion_json(const MotionVerdict& verdict) {
  json result{{"status", status_text(verdict.status)}, {"touches", verdict.touches}, {"parts", verdict.cells}};
  if (verdict.pose) {
    result["collision"] = pose_json(*verdict.pose);
    result["collision"]["parameter"] = verdict.parameter;
  }
  if (verdict.status == MotionVerdict::Status::kUndecided) {
    for (const auto& part : verdict.undecided) result["undecided"].push_back({part[0], part[1]});
  }
  return result;
}

json certified_json(const CertifiedPath& path, const std::vector<RigidPose>& poses, const Scene& scene) {
  json result{{"scene", scene.name}, {"status", status_text(path.status)}, {"motions", "rigid"}};
  for (const RigidPose& pose : poses) result["path"].push_back(pose_json(pose));
  for (const MotionVerdict& verdict : path.motions) result["verdicts"].push_back(motion_json(verdict));
  if (path.blocked) result["blocked_segment"] = *path.blocked;
  return result;
}

void print(const CertifiedPath& path) {
  std::cout << status_text(path.status);
  if (path.status == MotionVerdict::Status::kFree) {
    if (path.motions.size() == 1) {
      std::cout << ": the motion is free";
    } else {
      std::cout << ": all " << path.motions.size() << " motions are free";
    }
  } else if (path.blocked) {
    const MotionVerdict& verdict = path.motions[*path.blocked];
    std::cout << ": motion " << *path.blocked << " collides at position";
    for (const Rational& x : verdict.pose->position) std::cout << ' ' << nearest_double(x);
    std::cout << ", quaternion";
    for (const Rational& x : verdict.pose->quaternion) std::cout << ' ' << nearest_double(x);
  } else {
    std::cout << ": motions";
    for (std::size_t i = 0; i < path.motions.size(); ++i) {
      if (path.motions[i].status == MotionVerdict::Status::kUndecided) std::cout << ' ' << i;
    }
    std::cout << " come too close to obstacles to be decided";
  }
  std::cout << '\n';
}

}  // namespace

int run_certify(const Arguments& a, const Scene& scene, const std::vector<RigidPose>& poses) {
  exclude(a, "a path with rotations", {"--tight", "--queries", "--page", "--widest", "--widest-box"});
  require_extensions(a, "for a path with rotations", {"json"});
  const Stopwatch watch;
  const Scene unturned = with_robot_as_in_its_file(scene, a.session.monitor);
  const MotionChecker checker = MotionChecker::of_scene(unturned, a.session.monitor);
  const double setup_s = watch.seconds();
  CheckLimits limits;
  limits.keep_parts = !a.proof.empty();
  const CertifiedPath path = certify(checker, poses, MotionTiming::kSlerp, limits);
  write_path_proof(a, checker, poses, path);
  tell(a, {"certify",
           scene.name,
           [&] { return certified_json(path, poses, scene); },
           {{"setup", setup_s, {}}, {"op", watch.seconds() - setup_s, {}}},
           [&] { print(path); }});
  if (path.status == MotionVerdict::Status::kFree) return 0;
  return path.status == MotionVerdict::Status::kCollides ? 1 : 5;
}

}  // namespace nef::planner
