// SPDX-License-Identifier: Apache-2.0
//
// One run: certify the path motion by motion, write its proof, the report, pages and glTF files. What is said of a path
// is the same for robots of one body and of several links (linkage_run.cpp).
#include "apps/planner/command/runs/runs.h"

#include <Eigen/Geometry>
#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {
namespace {

using nlohmann::json;

json motion_json(const MotionVerdict& verdict) {
  json result{{"status", status_name(verdict.status)}, {"touches", verdict.touches}, {"parts", verdict.cells}};
  if (verdict.pose) {
    result["collision"] = pose_json(*verdict.pose);
    result["collision"]["parameter"] = verdict.parameter;
  }
  if (verdict.status == MotionVerdict::Status::kUndecided) result["undecided"] = parts_json(verdict.undecided);
  return result;
}

void print(const CertifiedPath& path) {
  std::vector<MotionVerdict::Status> motions;
  for (const MotionVerdict& verdict : path.motions) motions.push_back(verdict.status);
  std::cout << certified_text(path.status, motions);
  if (path.blocked) {
    const MotionVerdict& verdict = path.motions[*path.blocked];
    std::cout << ": motion " << *path.blocked << " collides at position";
    for (const Rational& x : verdict.pose->position) std::cout << ' ' << nearest_double(x);
    std::cout << ", quaternion";
    for (const Rational& x : verdict.pose->quaternion) std::cout << ' ' << nearest_double(x);
  }
  std::cout << '\n';
}

}  // namespace

json certified_json(const CertifiedPath& path, const std::vector<RigidPose>& poses, const Scene& scene) {
  json result{
      {"scene", scene.name}, {"status", status_name(path.status)}, {"motions", kRigid}, {"verdicts", json::array()}};
  for (const RigidPose& pose : poses) result["path"].push_back(pose_json(pose));
  for (const MotionVerdict& verdict : path.motions) result["verdicts"].push_back(motion_json(verdict));
  if (path.blocked) result["blocked_segment"] = *path.blocked;
  return result;
}

std::vector<view::Layer> certified_layers(const CertifiedPath& path, std::vector<RigidPose> poses, const Scene& scene,
                                          const MotionChecker& checker) {
  if (path.blocked) {
    poses.resize(*path.blocked + 1);
    poses.push_back(*path.motions[*path.blocked].pose);
  }
  std::vector<view::Layer> layers = scene_layers(scene, map_of(poses.front()), map_of(poses.back()), true, nullptr);
  std::vector<Rational3> points;
  std::vector<double> lengths;
  std::vector<Eigen::Quaterniond> turns;
  const double reach = checker.robot().nodes().front().reach;
  for (const RigidPose& pose : poses) {
    Eigen::Quaterniond turn = PoseMetric::rounded(pose.quaternion);
    if (!turns.empty()) {
      if (turn.dot(turns.back()) < 0) turn.coeffs() *= -1;  // the shorter arc
      lengths.push_back((to_vector(pose.position) - to_vector(points.back())).norm() +
                        reach * turn.angularDistance(turns.back()));
    }
    points.push_back(pose.position);
    turns.push_back(turn);
  }
  const auto turn_at = [&](std::size_t i) {
    const Eigen::Quaterniond turn = turns[i] * turns.front().conjugate();
    return std::array{turn.w(), turn.x(), turn.y(), turn.z()};
  };
  move_along(points, lengths, turn_at, layers);
  return layers;
}

json parts_json(const std::vector<std::array<double, 2>>& parts) {
  json ranges = json::array();
  for (const auto& part : parts) {
    if (!ranges.empty() && ranges.back()[1] == part[0]) {
      ranges.back()[1] = part[1];
    } else {
      ranges.push_back({part[0], part[1]});
    }
  }
  return ranges;
}

std::string certified_text(MotionVerdict::Status status, const std::vector<MotionVerdict::Status>& motions) {
  std::string text = status_name(status);
  if (status == MotionVerdict::Status::kFree) {
    text +=
        motions.size() == 1 ? ": the motion is free" : ": all " + std::to_string(motions.size()) + " motions are free";
  } else if (status == MotionVerdict::Status::kUndecided && motions.empty()) {
    text += ": the time was over";
  } else if (status == MotionVerdict::Status::kUndecided) {
    text += ": motions";
    for (std::size_t i = 0; i < motions.size(); ++i) {
      if (motions[i] == MotionVerdict::Status::kUndecided) text += ' ' + std::to_string(i);
    }
    text += " come too close to obstacles to be decided";
  }
  return text;
}

int certified_exit_code(MotionVerdict::Status status) {
  if (status == MotionVerdict::Status::kFree) return 0;
  return status == MotionVerdict::Status::kCollides ? 1 : 5;
}

int run_certify(const Arguments& a, const Scene& scene, const std::vector<RigidPose>& poses, const TimeLimit& limit) {
  exclude(a, "a path with rotations", {"--tight", "--queries", "--widest", "--widest-box"});
  require_extensions(a, "for a path with rotations", {"json", "glb", "html"});
  const Stopwatch watch;
  const Scene unturned = with_robot_as_in_its_file(scene, limit.monitor());
  const MotionChecker checker = MotionChecker::of_scene(unturned, limit.monitor());
  const double setup_s = watch.seconds();
  CheckLimits limits;
  limits.keep_parts = !a.proof.empty();
  CertifiedPath path;
  try {
    path = certify(checker, poses, MotionTiming::kSlerp, limits, limit.monitor());
  } catch (const Interrupted&) {
    path.status = MotionVerdict::Status::kUndecided;
  }
  write_path_proof(a, checker, poses, path);
  tell(a, {"certify",
           scene.name,
           [&] { return certified_json(path, poses, scene); },
           {{"setup", setup_s, {}}, {"op", watch.seconds() - setup_s, {}}},
           [&] { print(path); },
           nullptr,
           [&] { return certified_layers(path, poses, unturned, checker); }});
  return certified_exit_code(path.status);
}

}  // namespace nef::planner
