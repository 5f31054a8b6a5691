// SPDX-License-Identifier: Apache-2.0
//
// A scene of translations, as its file says it, with other ends and with obstacles moved. Only a path is looked for
// unless free space is wanted, too. What rests comes from a cache.
#include <map>
#include <memory>

#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/partial_answer.h"
#include "apps/planner/path/question.h"
#include "apps/planner/scene/scene.h"
#include "apps/program/reports/exact_json.h"
#include "apps/studio/panels/panel.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {
namespace {

// More obstacles than this are drawn as one.
constexpr std::size_t kMostLayers = 60;

std::optional<Rational3> point_field(const Json& request, const std::string& member) {
  const auto found = request.find(member);
  if (found == request.end() || found->is_null()) return std::nullopt;
  try {
    return point_of(nlohmann::json(*found), member);
  } catch (const InputError& error) {
    throw FieldError(member, 0, error.what());
  }
}

// The translations of obstacles that are to be moved, by their numbers, ascending.
std::map<std::size_t, Rational3> moves_of(const Json& request, std::size_t obstacles) {
  std::map<std::size_t, Rational3> result;
  const auto moves = request.find("moves");
  if (moves == request.end() || !moves->is_object()) return result;
  for (const auto& [number, move] : moves->items()) {
    std::size_t i = 0;
    while (i < obstacles && std::to_string(i) != number) ++i;
    if (i == obstacles) throw InputError("the scene has no obstacle " + number);
    result[i] = point_of(nlohmann::json(move), "a move");
  }
  return result;
}

// As those of the planner's pages, but for the obstacles: those that are moved, or all if they are few, are layers of
// their own, the others a piece that stays.
void draw_answer(const planner::Answer& answer, const planner::Scene& scene, const planner::FreeSpace* free,
                 RestingScene& resting, const std::map<std::size_t, Rational3>& moves, const Monitor& monitor,
                 PanelResult& result) {
  planner::Scene without = scene;
  without.obstacles.clear();
  result.layers = planner::view_layers(answer, without, free);
  const bool all = scene.obstacles.size() <= kMostLayers;
  std::vector<planner::ShownSet> parts;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    if (!all && !moves.contains(i)) continue;
    parts.push_back(
        {"obstacle " + std::to_string(i), scene.obstacles[i], planner::kObstaclesColor, planner::kObstaclesOpacity});
  }
  std::vector<view::Layer> obstacles = planner::layers_of(parts);
  result.layers.insert(result.layers.end(), std::make_move_iterator(obstacles.begin()),
                       std::make_move_iterator(obstacles.end()));
  if (all) return;
  Piece rest = resting.obstacles(monitor);
  if (rest.scene) result.pieces.push_back(std::move(rest));
}

// The free positions where some obstacles are moved: those among the others, less what the moved ones forbid.
Polyhedron free_positions_of(const planner::Scene& scene, const std::map<std::size_t, Rational3>& moves,
                             RestingScene& resting, const Monitor& monitor) {
  if (moves.empty() || !planner::obstacles_are_independent(scene)) return planner::free_positions(scene, monitor);
  planner::Scene now = resting.scene();
  Polyhedron free = resting.free_positions(monitor);
  for (const auto& [i, move] : moves) {
    const planner::ObstacleChange comes{std::nullopt, scene.obstacles[i]};
    free = planner::free_positions_after(comes, now, free, monitor);
    planner::apply(comes, now);
  }
  return free;
}

// As a Problem finds it, in free positions that are known.
planner::Answer answer_in(const planner::FreeSpace& free, const planner::Scene& scene,
                          const planner::PathOptions& options, const Monitor& monitor) {
  if (auto invalid = planner::Problem::invalid_end(scene, *scene.start, *scene.goal, monitor)) return *invalid;
  const planner::CellId start = free.locate(planner::ExactPoint(*scene.start));
  const planner::CellId goal = free.locate(planner::ExactPoint(*scene.goal));
  planner::Answer answer;
  answer.start_component = free.component(start);
  answer.goal_component = free.component(goal);
  answer.thinness = free.thinness(start, goal);
  answer.path = planner::find_path(free, *scene.start, *scene.goal, options, monitor);
  answer.status = answer.path ? planner::AnswerStatus::kPath : planner::AnswerStatus::kInfeasible;
  return answer;
}

}  // namespace

PanelResult planner_panel(const Json& request, const PanelContext& context) {
  const ScenePointer file =
      context.scenes.scene(context.root, text_of(request, "scene"), text_of(request, "folder"), context.monitor);
  planner::Scene scene = *file;
  if (!scene.only_translates()) {
    throw UnsupportedError("the studio plans translations; for this scene, whose robot turns, run planner");
  }
  if (const auto start = point_field(request, "start")) scene.start = start;
  if (const auto goal = point_field(request, "goal")) scene.goal = goal;
  const std::map<std::size_t, Rational3> moves = moves_of(request, scene.obstacles.size());
  for (const auto& [i, move] : moves) {
    scene.obstacles[i] = transform(scene.obstacles[i], AffineMap::translate(move), context.monitor);
  }
  std::vector<std::size_t> moved;
  for (const auto& [i, move] : moves) moved.push_back(i);
  const std::shared_ptr<RestingScene> resting = context.scenes.resting(file, moved);
  const bool wants_free = request.value("free", false);
  planner::PathOptions options;
  options.thorough = !request.value("dragged", false);
  const Stopwatch watch;
  planner::Answer answer;
  std::unique_ptr<const planner::FreeSpace> free;
  const bool has_question = scene.start && scene.goal;
  std::optional<planner::Answer> early;
  if (has_question && !wants_free) {
    early = planner::Problem::invalid_end(scene, *scene.start, *scene.goal, context.monitor);
    if (!early) early = planner::partial_answer(scene, options, context.monitor);
  }
  if (early) {
    answer = *std::move(early);
  } else {
    free = std::make_unique<const planner::FreeSpace>(free_positions_of(scene, moves, *resting, context.monitor));
    if (has_question) answer = answer_in(*free, scene, options, context.monitor);
  }
  PanelResult result;
  result.report["op_s"] = watch.seconds();
  result.report["answer"] = planner::answer_report(answer, scene, free.get());
  result.report["obstacles"] = scene.obstacle_names;
  result.report["notes"] = scene.messages;
  for (const auto& [name, point] : {std::pair{"start", scene.start}, std::pair{"goal", scene.goal}}) {
    result.report[name] = point ? Json(exact_json(*point)) : Json();
  }
  draw_answer(answer, scene, free.get(), *resting, moves, context.monitor, result);
  result.sets.emplace("robot", scene.robot);
  if (free != nullptr) result.sets.emplace("free space", free->set());
  return result;
}

}  // namespace nef::studio
