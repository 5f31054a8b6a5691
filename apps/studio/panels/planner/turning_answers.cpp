// SPDX-License-Identifier: Apache-2.0
//
// Robots that turn. While something is dragged, the searches are cut short: an answer that takes long is looked for
// when it is dropped.
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/command/runs/runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/studio/panels/planner/planner_question.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {
namespace {

constexpr std::size_t kCellsWhileDragged = 60;
constexpr std::size_t kSlicesWhileDragged = 60;

template <typename Answer>
Json answer_json(const Answer& answer, const char* motions, const planner::Scene& scene) {
  Json json{{"status", planner::status_name(answer.status)}, {"motions", motions}, {"waypoints", answer.path.size()}};
  if (answer.collision) json["collision"] = planner::collision_json(*answer.collision, scene);
  return json;
}

// The question without an answer, where it has no ends.
void answer_nothing(const PlannerQuestion& question, const char* motions, const Monitor& monitor, PanelResult& result) {
  result.report["op_s"] = 0;
  result.report["answer"] = {{"status", planner::status_name(planner::AnswerStatus::kNoQuestion)},
                             {"motions", motions}};
  draw_scene(planner::scene_layers(without_obstacles(question.scene), {}, {}, false, nullptr), question, monitor,
             result);
}

bool has_valid_ends(planner::AnswerStatus status) {
  return status != planner::AnswerStatus::kInvalidStart && status != planner::AnswerStatus::kInvalidGoal;
}

// run() asks the planner.
template <typename Run>
void ask_ompl(const PlannerQuestion& question, const Run& run, PanelResult& result) {
  const Stopwatch watch;
  const auto found = run();
  const bool is_path = found.status == planner::AnswerStatus::kPath;
  std::vector<Rational3> points;
  for (const auto& pose : found.path) points.push_back(pose.position);
  add_ompl(question,
           {{"status", is_path ? "path" : "none"}, {"waypoints", points.size()}, {"seconds", watch.seconds()}}, points,
           result);
}

}  // namespace

void answer_turning(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result) {
  const planner::Scene& scene = question.scene;
  if (!question.has_ends()) return answer_nothing(question, planner::kTranslationAndTurning, monitor, result);
  const planner::TurningQuestion asked = planner::question_of(scene);
  planner::TurningLimits limits;
  if (question.dragged) limits.max_cells = kCellsWhileDragged;
  const Stopwatch watch;
  const planner::TurningAnswer answer = planner::find_turning_path(scene, asked, limits, monitor);
  result.report["op_s"] = watch.seconds();
  result.report["answer"] = answer_json(answer, planner::kTranslationAndTurning, scene);
  result.report["answer"]["cells"] = answer.cells;
  draw_scene(planner::turning_layers(answer, without_obstacles(scene), asked), question, monitor, result);
  if (!question.runs_ompl() || !has_valid_ends(answer.status)) return;
  ask_ompl(
      question, [&] { return planner::run_turning_ompl(scene, question.ompl, question.seconds, monitor); }, result);
}

void answer_rigid(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result) {
  const planner::Scene& scene = question.scene;
  if (!question.has_ends()) return answer_nothing(question, planner::kRigid, monitor, result);
  const Stopwatch watch;
  const auto shared = std::make_shared<const planner::MotionChecker>(planner::MotionChecker::of_scene(scene, monitor));
  const planner::MotionChecker& checker = *shared;
  const planner::RigidLimits limits =
      planner::RigidLimits::of(question.dragged ? std::optional(kSlicesWhileDragged) : std::nullopt, false);
  const planner::RigidAnswer answer = planner::find_rigid_path(scene, checker, limits, monitor);
  result.report["op_s"] = watch.seconds();
  Json json = answer_json(answer, planner::kRigid, scene);
  json["samples"] = answer.samples;
  json["slices"] = answer.slices;
  json["boxes"] = answer.boxes;
  result.report["answer"] = std::move(json);
  const planner::Scene without = without_obstacles(scene);
  const planner::RigidQuestion ends = planner::rigid_question_of(scene);
  draw_scene(answer.path.empty() ? planner::scene_layers(without, planner::map_of(ends.start),
                                                         planner::map_of(ends.goal), false, nullptr)
                                 : planner::certified_layers(answer.certified, answer.path, without, checker),
             question, monitor, result);
  if (!question.runs_ompl() || !has_valid_ends(answer.status)) return;
  ask_ompl(
      question, [&] { return planner::run_rigid_ompl(scene, shared, question.ompl, question.seconds, monitor); },
      result);
}

}  // namespace nef::studio
