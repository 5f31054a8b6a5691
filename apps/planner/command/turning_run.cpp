// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/turning_run.h"

#include <iostream>

#include "apps/planner/command/clearance_run.h"
#include "apps/planner/command/ompl_runs.h"
#include "apps/planner/command/proof_run.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/command/turning_report.h"
#include "apps/planner/command/turning_view.h"
#include "apps/program/run_report.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

void print(const Arguments& a, const TurningAnswer& answer, const TurningAxis& axis) {
  std::cout << status_name(answer.status);
  if (a.ompl.empty()) std::cout << ", " << answer.cells << " cells of angles";
  if (answer.status == TurningAnswer::Status::kUndecided) {
    std::cout << "; open:";
    for (const TurnRange& range : answer.open_ranges) {
      std::cout << ' ' << axis.degrees_of(range.low) << ".." << axis.degrees_of(range.high);
    }
  }
  std::cout << '\n';
  if (!answer.unrounded.empty()) std::cout << unrounded_text(answer.unrounded);
  if (a.outputs.empty()) std::cout << turning_text(answer, axis);
}

int check_proof(const Arguments& a, const Scene& scene) {
  const Stopwatch watch;
  const TurningProof proof = read_turning_proof(a.check_proof);
  const std::optional<std::string> complaint = complaint_about(proof, scene, question_of(scene));
  const std::size_t cells = proof.cells.size();
  return tell_check(a, scene, complaint, {{"cells", cells}}, ", " + std::to_string(cells) + " cells of angles", watch);
}

}  // namespace

int run_turning(const Arguments& a, const Scene& scene, const nlohmann::json& widest) {
  exclude(a, "a scene with a rotation",
          {"--tight", "--path", "--queries", "--benchmark", "--min-dimension", "--clearance", "--raw", "--quick",
           "--prefer", "--se3", "--proof"});
  require_extensions(a, "for a scene with a rotation", {"json", "txt", "csv", "glb", "html"});
  if (!a.ompl.empty() && a.path.digits) {
    throw InputError("--digits: what OMPL's planners find for a robot that turns is not rounded");
  }
  if (!a.check_proof.empty()) return check_proof(a, scene);
  const TimeLimit limit(a.time, a.session.monitor);
  TurningLimits limits;
  limits.max_cells = a.max_cells;
  limits.digits = a.path.digits;
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer = a.ompl.empty() ? find_turning_path(scene, question, limits, limit.monitor())
                                              : run_turning_ompl(scene, a.ompl, a.time.value_or(kOmplSeconds));
  nlohmann::json report = turning_json(answer, scene, question.axis);
  std::vector<double> times;
  if (!answer.path.empty() && a.limits.speed > 0)
    times = times_of(lengths_of(answer.path, scene.robot, question.axis), a.limits);
  if (!times.empty()) report["times_s"] = times;
  if (!widest.is_null()) report["widest"] = widest;
  std::string text = report_text(run_report("turning", report, {{"op", limit.passed(), {}}}, scene.messages));
  // The report whatever the answer; other formats hold a path.
  const auto rendered = [&](const std::string& file) -> std::optional<std::string> {
    const std::string extension = lower_extension(file);
    if (extension == "json") return text;
    if (answer.status != TurningAnswer::Status::kPath) return std::nullopt;
    if (extension != "csv") return turning_text(answer, question.axis);
    return timed_text("x,y,z,degrees", times, [&](std::size_t i) {
      const Vector3d at = to_vector(answer.path[i].position);
      return std::vector<double>{at[0], at[1], at[2], question.axis.degrees_of(answer.path[i].turn)};
    });
  };
  write_outputs(a, scene.name, rendered, [&] { return turning_layers(answer, scene, question); });
  const auto print_answer = [&] {
    if (!widest.is_null()) std::cout << widest_text(widest);
    print(a, answer, question.axis);
  };
  print_result(
      a, [&] { return text; }, print_answer);
  const bool no_answer = !a.ompl.empty() && answer.status == TurningAnswer::Status::kUndecided;
  return no_answer ? 4 : exit_code(answer.status);
}

}  // namespace nef::planner
