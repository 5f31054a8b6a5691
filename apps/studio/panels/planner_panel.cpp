// SPDX-License-Identifier: Apache-2.0
//
// A scene of translations, as its file says it, with other ends and with obstacles moved. Only a path is looked for
// unless free space is wanted too; obstacles stay layers of their own, so that the page can take hold of them.
#include <algorithm>
#include <numeric>

#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/path/partial_answer.h"
#include "apps/planner/path/question.h"
#include "apps/planner/scene/scene.h"
#include "apps/program/expression/expression.h"
#include "apps/program/reports/exact_json.h"
#include "apps/studio/panels/panel.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {
namespace {

// More obstacles than this are drawn as one.
constexpr std::size_t kMostLayers = 60;

// The files that a shape names must be below the root, whether it is a name or an expression.
void check_shape(const std::string& text, const std::string& folder, const RootFolder& root) {
  std::error_code error;
  const std::string name = text.substr(0, text.rfind('#'));
  if (std::filesystem::exists(root.path() / folder / name, error)) {
    static_cast<void>(root.mesh(text, folder));
    return;
  }
  std::vector<std::string> files;
  try {
    files = files_of_expression(text);
  } catch (const InputError&) {
    return;  // the reader of scenes words it
  }
  for (const std::string& file : files) static_cast<void>(root.mesh(file, folder));
}

void check_shapes(const nlohmann::json& value, const std::string& folder, const RootFolder& root) {
  if (value.is_string()) check_shape(value.get<std::string>(), folder, root);
  if (value.is_array() || value.is_object()) {
    for (const nlohmann::json& item : value) check_shapes(item, folder, root);
  }
}

std::optional<Rational3> point_field(const Json& request, const std::string& member) {
  const auto found = request.find(member);
  if (found == request.end() || found->is_null()) return std::nullopt;
  try {
    return point_of(nlohmann::json(*found), member);
  } catch (const InputError& error) {
    throw FieldError(member, 0, error.what());
  }
}

planner::Scene scene_of(const Json& request, const PanelContext& context) {
  const std::string text = text_of(request, "scene");
  const std::string folder = text_of(request, "folder");
  // Also when nothing of it is a file: it is where names begin.
  if (!folder.empty() && std::filesystem::path(folder).is_absolute())
    throw InputError("the folder must be below the root");
  const nlohmann::json scene_json = parse_exact_json(text, "the scene");
  check_shapes(scene_json, folder, context.root);
  planner::Scene scene = planner::parse_scene(text, (context.root.path() / folder).string(), "the scene",
                                              planner::scene_meshes(context.monitor));
  if (!scene.only_translates()) {
    throw UnsupportedError("the studio plans translations; for this scene, whose robot turns, run planner");
  }
  if (const auto start = point_field(request, "start")) scene.start = start;
  if (const auto goal = point_field(request, "goal")) scene.goal = goal;
  const auto moves = request.find("moves");
  if (moves != request.end() && moves->is_object()) {
    std::vector<std::size_t> names(scene.obstacles.size());
    std::iota(names.begin(), names.end(), std::size_t{0});
    for (const auto& [number, move] : moves->items()) {
      const auto at = std::find_if(names.begin(), names.end(),
                                   [&number = number](std::size_t i) { return std::to_string(i) == number; });
      if (at == names.end()) throw InputError("the scene has no obstacle " + number);
      Polyhedron& obstacle = scene.obstacles[*at];
      obstacle = transform(obstacle, AffineMap::translate(point_of(nlohmann::json(move), "a move")), context.monitor);
    }
  }
  return scene;
}

// As those of the planner's pages, but for the obstacles.
std::vector<view::Layer> layers_of_answer(const planner::Answer& answer, const planner::Scene& scene,
                                          const planner::FreeSpace* free) {
  planner::Scene without = scene;
  without.obstacles.clear();
  std::vector<view::Layer> layers = planner::view_layers(answer, without, free);
  std::vector<planner::ShownSet> parts;
  for (std::size_t i = 0; scene.obstacles.size() <= kMostLayers && i < scene.obstacles.size(); ++i) {
    parts.push_back(
        {"obstacle " + std::to_string(i), scene.obstacles[i], planner::kObstaclesColor, planner::kObstaclesOpacity});
  }
  if (parts.empty() && !scene.obstacles.empty()) {
    parts.push_back({"obstacles", unite_all(scene.obstacles), planner::kObstaclesColor, planner::kObstaclesOpacity});
  }
  std::vector<view::Layer> obstacles = planner::layers_of(parts);
  layers.insert(layers.end(), std::make_move_iterator(obstacles.begin()), std::make_move_iterator(obstacles.end()));
  return layers;
}

}  // namespace

PanelResult planner_panel(const Json& request, const PanelContext& context) {
  const planner::Scene scene = scene_of(request, context);
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
  result.layers = layers_of_answer(answer, scene, free);
  result.sets.emplace("robot", scene.robot);
  if (free != nullptr) result.sets.emplace("free space", free->set());
  return result;
}

}  // namespace nef::studio
