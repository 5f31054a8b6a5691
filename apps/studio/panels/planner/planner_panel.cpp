// SPDX-License-Identifier: Apache-2.0
//
// The scene as the request has it, with its ends and obstacles where they are now; the kind of its motions decides who
// answers. Obstacles that rest are drawn as one piece that stays, so that a page gets it once.
#include <algorithm>

#include "apps/planner/command/ends.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/program/reports/exact_json.h"
#include "apps/studio/panels/planner/planner_question.h"
#include "nef/io/number_text.h"

namespace nef::studio {
namespace {

// More obstacles than this are drawn as one.
constexpr std::size_t kMostLayers = 60;
constexpr view::Color kOmplPath{120, 60, 170};
constexpr double kMostSeconds = 60;

// Start or goal of the request: a list of three or more numbers, or null.
void take_end_of(const Json& request, const std::string& member, planner::Scene& scene) {
  const auto found = request.find(member);
  if (found == request.end() || !found->is_array()) return;
  std::string text;
  for (const Json& number : *found) {
    text += (text.empty() ? "" : ",") + (number.is_string() ? number.get<std::string>() : number.dump());
  }
  try {
    planner::take_end(text, member, scene, member == "goal");
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

// With the turn, as the request has it.
Json end_json(const planner::Scene& scene, bool is_goal) {
  const std::optional<Rational3>& position = is_goal ? scene.goal : scene.start;
  if (!position) return nullptr;
  Json numbers = exact_json(*position);
  if (scene.rotation) numbers.push_back(to_string(is_goal ? scene.rotation->goal : scene.rotation->start));
  if (scene.turns_freely && scene.quaternions) {
    for (const Rational& x : (*scene.quaternions)[is_goal ? 1 : 0]) numbers.push_back(to_string(x));
  }
  return numbers;
}

PlannerQuestion question_of(const Json& request, const PanelContext& context) {
  const ScenePointer file =
      context.scenes.scene(context.root, text_of(request, "scene"), text_of(request, "folder"), context.monitor);
  PlannerQuestion question;
  question.scene = *file;
  planner::Scene& scene = question.scene;
  take_end_of(request, "start", scene);
  take_end_of(request, "goal", scene);
  question.moves = moves_of(request, scene.obstacles.size());
  std::vector<std::size_t> moved;
  for (const auto& [i, move] : question.moves) {
    scene.obstacles[i] = transform(scene.obstacles[i], AffineMap::translate(move), context.monitor);
    moved.push_back(i);
  }
  question.resting = context.scenes.resting(file, moved);
  question.free = request.value("free", false);
  question.dragged = request.value("dragged", false);
  if (request.contains("ompl")) question.ompl = text_of(request, "ompl");
  if (!question.ompl.empty()) planner::require_ompl_planner(question.ompl);
  const Json seconds = request.value("seconds", Json());
  if (seconds.is_number()) question.seconds = std::clamp(seconds.get<double>(), 0.1, kMostSeconds);
  return question;
}

}  // namespace

planner::Scene without_obstacles(const planner::Scene& scene) {
  planner::Scene without = scene;
  without.obstacles.clear();
  return without;
}

void draw_scene(std::vector<view::Layer> layers, const PlannerQuestion& question, const Monitor& monitor,
                PanelResult& result) {
  const planner::Scene& scene = question.scene;
  result.layers = std::move(layers);
  const bool all = scene.obstacles.size() <= kMostLayers;
  std::vector<planner::ShownSet> parts;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    if (!all && !question.moves.contains(i)) continue;
    parts.push_back(
        {"obstacle " + std::to_string(i), scene.obstacles[i], planner::kObstaclesColor, planner::kObstaclesOpacity});
  }
  std::vector<view::Layer> obstacles = planner::layers_of(parts);
  result.layers.insert(result.layers.end(), std::make_move_iterator(obstacles.begin()),
                       std::make_move_iterator(obstacles.end()));
  if (all) return;
  Piece rest = question.resting->obstacles(monitor);
  if (rest.scene) result.pieces.push_back(std::move(rest));
}

void add_ompl(const PlannerQuestion& question, Json found, const std::vector<Rational3>& path, PanelResult& result) {
  found["name"] = question.ompl;
  result.report["ompl"] = std::move(found);
  if (path.empty()) return;
  view::Layer& layer = result.layers.emplace_back();
  layer.name = "path of " + question.ompl;
  layer.color = kOmplPath;
  view::Polyline& line = layer.lines.emplace_back(view::Polyline{layer.name, {}, kOmplPath});
  for (const Rational3& point : path) line.points.push_back(nearest_doubles(point));
}

PanelResult planner_panel(const Json& request, const PanelContext& context) {
  const PlannerQuestion question = question_of(request, context);
  const planner::Scene& scene = question.scene;
  PanelResult result;
  result.report["obstacles"] = scene.obstacle_names;
  result.report["notes"] = scene.messages;
  result.report["start"] = end_json(scene, false);
  result.report["goal"] = end_json(scene, true);
  const auto answer = scene.turns_freely ? answer_rigid : scene.rotation ? answer_turning : answer_translations;
  answer(question, context.monitor, result);
  result.sets.emplace("robot", scene.robot);
  return result;
}

}  // namespace nef::studio
