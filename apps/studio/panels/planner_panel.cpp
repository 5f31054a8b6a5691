// SPDX-License-Identifier: Apache-2.0
//
// A scene of translations, as its file says it, with other ends and with obstacles moved. Only a path is looked for
// unless free space is wanted, too. What rests comes from a cache.
#include <map>
#include <memory>

#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
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
// their own.
std::vector<view::Layer> layers_of_answer(const planner::Answer& answer, const planner::Scene& scene,
                                          const planner::FreeSpace* free,
                                          const std::shared_ptr<const planner::Scene>& resting,
                                          const std::map<std::size_t, Rational3>& moves, const PanelContext& context) {
  planner::Scene without = scene;
  without.obstacles.clear();
  std::vector<view::Layer> layers = planner::view_layers(answer, without, free);
  const bool all = scene.obstacles.size() <= kMostLayers;
  std::vector<planner::ShownSet> parts;
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    if (!all && !moves.contains(i)) continue;
    parts.push_back(
        {"obstacle " + std::to_string(i), scene.obstacles[i], planner::kObstaclesColor, planner::kObstaclesOpacity});
    moved.push_back(i);
  }
  std::vector<view::Layer> obstacles = planner::layers_of(parts);
  if (!all) obstacles.push_back(context.scenes.other_obstacles(resting, moved, context.monitor));
  layers.insert(layers.end(), std::make_move_iterator(obstacles.begin()), std::make_move_iterator(obstacles.end()));
  return layers;
}

}  // namespace

PanelResult planner_panel(const Json& request, const PanelContext& context) {
  const std::shared_ptr<const planner::Scene> resting =
      context.scenes.scene(context.root, text_of(request, "scene"), text_of(request, "folder"), context.monitor);
  planner::Scene scene = *resting;
  if (!scene.only_translates()) {
    throw UnsupportedError("the studio plans translations; for this scene, whose robot turns, run planner");
  }
  if (const auto start = point_field(request, "start")) scene.start = start;
  if (const auto goal = point_field(request, "goal")) scene.goal = goal;
  const std::map<std::size_t, Rational3> moves = moves_of(request, scene.obstacles.size());
  for (const auto& [i, move] : moves) {
    scene.obstacles[i] = transform(scene.obstacles[i], AffineMap::translate(move), context.monitor);
  }
  const bool wants_free = request.value("free", false);
  const Stopwatch watch;
  planner::Answer answer;
  std::optional<planner::Problem> problem;
  const bool has_question = scene.start && scene.goal;
  std::optional<planner::Answer> early;
  if (has_question && !wants_free) {
    early = planner::Problem::invalid_end(scene, *scene.start, *scene.goal, context.monitor);
    if (!early) early = planner::partial_answer(scene, {}, context.monitor);
  }
  if (early) {
    answer = *std::move(early);
  } else {
    problem.emplace(scene, context.monitor);
    if (has_question) answer = problem->solve({}, context.monitor);
  }
  const planner::FreeSpace* free = problem ? &problem->free_space() : nullptr;
  PanelResult result;
  result.report["op_s"] = watch.seconds();
  result.report["answer"] = planner::answer_report(answer, scene, free);
  result.report["obstacles"] = scene.obstacle_names;
  result.report["notes"] = scene.messages;
  for (const auto& [name, point] : {std::pair{"start", scene.start}, std::pair{"goal", scene.goal}}) {
    result.report[name] = point ? Json(exact_json(*point)) : Json();
  }
  result.layers = layers_of_answer(answer, scene, free, resting, moves, context);
  result.sets.emplace("robot", scene.robot);
  if (free != nullptr) result.sets.emplace("free space", free->set());
  return result;
}

}  // namespace nef::studio
