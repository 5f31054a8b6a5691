// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/turning_run.h"

#include <filesystem>
#include <iostream>

#include "apps/planner/command/clearance_run.h"
#include "apps/planner/command/ompl_runs.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/command/turning_report.h"
#include "apps/planner/command/turning_view.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/program/run_report.h"

namespace nef::planner {
namespace {

void check_turning_options(const Arguments& a) {
  const bool other = a.tight || !a.given_path.empty() || !a.queries.empty() || !a.benchmark.empty() ||
                     a.path.min_dimension > 0 || a.path.clearance || a.path.raw || !a.path.thorough ||
                     a.prefer != "short" || a.se3 || !a.proof.empty();
  if (other) {
    throw InputError(
        "a scene with a rotation knows --json, --quiet, --page, -o, --max-cells, --time, --digits, --ompl and "
        "--check-proof only");
  }
  if (!a.ompl.empty() && a.path.digits) {
    throw InputError("--digits: what OMPL's planners find for a robot that turns is not rounded");
  }
  for (const std::string& file : a.outputs) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension != ".json" && extension != ".txt" && extension != ".csv" && !is_view_file(file)) {
      throw InputError("-o " + file +
                       ": for a scene with a rotation the extension must be .json, .txt, .csv, .glb or .html");
    }
  }
}

void print(const Arguments& a, const TurningAnswer& answer, const TurningAxis& axis) {
  std::cout << name_of(answer.status);
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
  if (a.json) {
    nlohmann::json report{{"scene", scene.name}, {"holds", !complaint}, {"cells", proof.cells.size()}};
    if (complaint) report["complaint"] = *complaint;
    std::cout << report_text(run_report("check_proof", report, {{"op", watch.seconds(), {}}}, scene.messages));
  } else if (!a.quiet) {
    std::cout << (complaint ? "the proof does not hold: " + *complaint
                            : "the proof holds, " + std::to_string(proof.cells.size()) + " cells of angles")
              << '\n';
  }
  return complaint ? 1 : 0;
}

}  // namespace

int run_turning(const Arguments& a, const Scene& scene, const nlohmann::json& widest) {
  check_turning_options(a);
  if (!a.check_proof.empty()) return check_proof(a, scene);
  const Stopwatch watch;
  TurningLimits limits;
  limits.max_cells = a.max_cells;
  limits.digits = a.path.digits;
  if (a.time_given) limits.stop = [&] { return watch.seconds() >= a.seconds; };
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer =
      a.ompl.empty() ? find_turning_path(scene, question, limits) : run_turning_ompl(scene, a.ompl, a.seconds);
  nlohmann::json report = turning_json(answer, scene, question.axis);
  std::vector<double> times;
  if (!answer.path.empty() && a.limits.speed > 0) times = times_along(answer.path, scene, question.axis, a.limits);
  if (!times.empty()) report["times_s"] = times;
  if (!widest.is_null()) report["widest"] = widest;
  const std::string text = report_text(run_report("turning", report, {{"op", watch.seconds(), {}}}, scene.messages));
  // The report whatever the answer; other formats hold a path.
  const auto rendered = [&](const std::string& file) -> std::optional<std::string> {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".json") return text;
    if (answer.status != TurningAnswer::Status::kPath) return std::nullopt;
    return extension == ".csv" ? turning_csv(answer, question.axis, times) : turning_text(answer, question.axis);
  };
  write_outputs(a, scene.name, rendered, [&] { return turning_layers(answer, scene, question); });
  if (a.json) {
    std::cout << text;
  } else if (!a.quiet) {
    if (!widest.is_null()) std::cout << widest_text(widest);
    print(a, answer, question.axis);
  }
  const bool no_answer = !a.ompl.empty() && answer.status == TurningAnswer::Status::kUndecided;
  return no_answer ? 4 : exit_code_of(answer.status);
}

}  // namespace nef::planner
