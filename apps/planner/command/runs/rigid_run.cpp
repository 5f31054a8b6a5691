// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/command/runs/runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/counted.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"

namespace nef::planner {
namespace {

using nlohmann::json;

RigidLimits limits_of(const Arguments& a) {
  const bool is_given = a.app->count("--max-cells") > 0;
  return RigidLimits::of(is_given ? std::optional(a.max_cells) : std::nullopt, a.time.has_value());
}

json rigid_json(const RigidAnswer& answer, const Scene& scene) {
  json result{{"scene", scene.name}, {"motions", kRigid}};
  if (!answer.path.empty()) result = certified_json(answer.certified, answer.path, scene);
  result["status"] = status_name(answer.status);
  result["contact"] = scene.contact == ContactRule::kAllow ? "allow" : "forbid";
  result["samples"] = answer.samples;
  result["slices"] = answer.slices;
  result["boxes"] = answer.boxes;
  if (!answer.in_question.boxes.empty()) {
    result["in_question"] = {{"reference", exact_json(answer.in_question.reference)},
                             {"boxes", answer.in_question.boxes}};
  }
  if (answer.collision) result["collision"] = collision_json(*answer.collision, scene);
  return result;
}

// A way-point in a line: x y z qx qy qz qw, as OMPL writes them.
std::string rigid_text(const std::vector<RigidPose>& path) {
  std::string out;
  for (const RigidPose& pose : path) {
    for (const Rational& x : pose.position) {
      append_number(out, nearest_double(x));
      out += ' ';
    }
    const Eigen::Quaterniond q = PoseMetric::rounded(pose.quaternion);
    for (const double x : {q.x(), q.y(), q.z()}) {
      append_number(out, x);
      out += ' ';
    }
    append_number(out, q.w());
    out += '\n';
  }
  return out;
}

void print(const Arguments& a, const RigidAnswer& answer, const Scene& scene) {
  std::cout << status_name(answer.status);
  switch (answer.status) {
    case RigidAnswer::Status::kPath:
      std::cout << ": " << counted(answer.path.size(), "way-point", "way-points") << ", every motion certified\n";
      if (a.outputs.empty()) std::cout << rigid_text(answer.path);
      break;
    case RigidAnswer::Status::kInfeasible:
      std::cout << " at every orientation, proved with " << counted(answer.boxes, "box", "boxes") << " of poses\n";
      break;
    case RigidAnswer::Status::kUndecided:
      if (!a.ompl.empty()) {
        std::cout << ": " << a.ompl << kNoPathInTime << '\n';
        break;
      }
      std::cout << ": no path found with " << counted(answer.samples, "sample", "samples") << " and "
                << counted(answer.slices, "slice", "slices") << ", which proves nothing\n";
      if (!answer.in_question.boxes.empty()) {
        std::cout << "in question: "
                  << counted(answer.in_question.boxes.size(), "box of positions", "boxes of positions")
                  << " in the way, which may not be blocked at all orientations\n";
      }
      break;
    default:
      std::cout << ": " << (answer.collision ? describe(*answer.collision, scene) : "it touches a surface") << '\n';
  }
}

// Of the path, or of the end that is not free.
void write_proof(const Arguments& a, const Scene& scene, const MotionChecker& checker, const RigidAnswer& answer) {
  if (a.proof.empty()) return;
  if (answer.status == RigidAnswer::Status::kUndecided) {
    std::cerr << "planner: " << a.proof << " was not written, because the answer is undecided\n";
    return;
  }
  if (answer.proof) {
    write_file(a.proof, proof_text(*answer.proof));
    return;
  }
  std::vector<RigidPose> poses = answer.path;
  if (poses.empty()) {
    const RigidQuestion question = rigid_question_of(scene);
    poses = {answer.status == RigidAnswer::Status::kInvalidStart ? question.start : question.goal};
  }
  write_path_proof(a, checker, poses);
}

}  // namespace

int run_rigid(const Arguments& a, const Scene& scene, const TimeLimit& limit) {
  exclude(a, "a robot that turns freely",
          {"--tight", "--queries", "--benchmark", "--min-dimension", "--clearance", "--raw", "--quick", "--prefer",
           "--digits", "--speed", "--se3"});
  require_extensions(a, "for a robot that turns freely", {"json", "txt", "path", "glb", "html"});
  const Stopwatch watch;
  const auto shared = std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene, limit.monitor()));
  const MotionChecker& checker = *shared;
  const double setup_s = watch.seconds();
  const RigidAnswer answer =
      a.ompl.empty() ? find_rigid_path(scene, checker, limits_of(a), limit.monitor())
                     : run_rigid_ompl(scene, shared, a.ompl, a.time.value_or(kOmplSeconds), a.session.monitor);
  const double op_s = watch.seconds() - setup_s;
  write_proof(a, scene, checker, answer);
  const auto text = [&](const std::string&) -> std::optional<std::string> {
    if (answer.path.empty()) return std::nullopt;
    return rigid_text(answer.path);
  };
  const auto layers = [&] {
    if (!answer.path.empty()) return certified_layers(answer.certified, answer.path, scene, checker);
    const RigidQuestion question = rigid_question_of(scene);
    return scene_layers(scene, map_of(question.start), map_of(question.goal), false, nullptr);
  };
  tell(a, {"rigid",
           scene.name,
           [&] { return rigid_json(answer, scene); },
           {{"setup", setup_s, {}}, {"op", op_s, {}}},
           [&] { print(a, answer, scene); },
           text,
           layers});
  return exit_code(answer.status, !a.ompl.empty());
}

}  // namespace nef::planner
