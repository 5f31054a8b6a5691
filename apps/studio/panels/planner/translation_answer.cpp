// SPDX-License-Identifier: Apache-2.0
//
// A path is looked for in a part of free space first, if nothing but a path is wanted. All of free space is that among
// the obstacles that rest, which is kept, less what those that move forbid.
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/partial_answer.h"
#include "apps/planner/path/question.h"
#include "apps/studio/panels/planner/planner_question.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {
namespace {

Polyhedron free_positions_of(const PlannerQuestion& question, const Monitor& monitor) {
  const planner::Scene& scene = question.scene;
  if (question.moves.empty() || !planner::obstacles_are_independent(scene)) {
    return planner::free_positions(scene, monitor);
  }
  planner::Scene now = question.resting->scene();
  Polyhedron free = question.resting->free_positions(monitor);
  for (const auto& [i, move] : question.moves) {
    const planner::ObstacleChange comes{std::nullopt, scene.obstacles[i]};
    free = planner::free_positions_after(comes, now, free, monitor);
    planner::apply(comes, now);
  }
  return free;
}

// What is known without all of free space.
std::optional<planner::Answer> early_answer(const PlannerQuestion& question, const planner::PathOptions& options,
                                            const Monitor& monitor) {
  const planner::Scene& scene = question.scene;
  if (auto invalid = planner::Problem::invalid_end(scene, *scene.start, *scene.goal, monitor)) return invalid;
  if (question.free || question.runs_ompl()) return std::nullopt;
  return planner::partial_answer(scene, options, monitor);
}

void ask_ompl(const PlannerQuestion& question, const planner::Problem& problem, const Monitor& monitor,
              PanelResult& result) {
  const planner::OmplOutcome found =
      planner::run_ompl(problem, {.planner = question.ompl, .seconds = question.seconds}, monitor);
  Json json{{"status", found.solved > 0       ? "path"
                       : found.exit_code == 1 ? "infeasible"
                                              : "none"},
            {"seconds", found.answer.phases.at("ompl")}};
  const auto& path = found.answer.path;
  if (path) json["length"] = path->length;
  add_ompl(question, std::move(json), path ? path->points : std::vector<Rational3>(), result);
}

}  // namespace

void answer_translations(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result) {
  const planner::Scene& scene = question.scene;
  planner::PathOptions options;
  options.thorough = !question.dragged;
  const Stopwatch watch;
  planner::Answer answer;
  std::optional<planner::Problem> problem;
  std::optional<planner::Answer> early;
  if (question.has_ends()) early = early_answer(question, options, monitor);
  if (early) answer = *std::move(early);
  if (answer.status == planner::AnswerStatus::kNoQuestion || (question.free && answer.collision)) {
    problem.emplace(scene, free_positions_of(question, monitor));
    if (question.has_ends() && !answer.collision) answer = problem->solve(options, monitor);
  }
  result.report["op_s"] = watch.seconds();
  const planner::FreeSpace* free = problem ? &problem->free_space() : nullptr;
  result.report["answer"] = planner::answer_report(answer, scene, free);
  draw_scene(planner::view_layers(answer, without_obstacles(scene), free), question, monitor, result);
  if (problem) result.sets.emplace("free space", free->set());
  if (problem && question.runs_ompl() && !answer.collision) ask_ompl(question, *problem, monitor, result);
}

}  // namespace nef::studio
