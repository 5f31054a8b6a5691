// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/caches/scene_cache.h"

#include "apps/planner/command/scene_view.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/scene/cfg.h"
#include "apps/program/expression/expression.h"
#include "apps/program/reports/exact_json.h"
#include "apps/view/page.h"
#include "nef/base/error.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

// The files that a shape names, whether it is a name or an expression. They must be below the root.
void add_files(const std::string& text, const std::string& folder, const RootFolder& root,
               std::vector<FileState>& files) {
  std::error_code error;
  if (fs::exists(root.path() / folder / text.substr(0, text.rfind('#')), error)) {
    files.push_back(state_of_mesh(root.mesh(text, folder)));
    return;
  }
  std::vector<std::string> names;
  try {
    names = files_of_expression(text);
  } catch (const InputError&) {
    return;  // the reader of scenes words it
  }
  for (const std::string& name : names) files.push_back(state_of_mesh(root.mesh(name, folder)));
}

void add_files(const nlohmann::json& value, const std::string& folder, const RootFolder& root,
               std::vector<FileState>& files) {
  if (value.is_string()) add_files(value.get<std::string>(), folder, root, files);
  if (value.is_array() || value.is_object()) {
    for (const nlohmann::json& item : value) add_files(item, folder, root, files);
  }
}

}  // namespace

RestingScene::RestingScene(const planner::Scene& scene, const std::vector<std::size_t>& but, std::uint64_t piece)
    : scene_(scene), piece_(piece) {
  for (auto i = but.rbegin(); i != but.rend(); ++i) planner::apply({*i, std::nullopt}, scene_);
}

Piece RestingScene::obstacles(const Monitor& monitor) {
  const std::lock_guard lock(mutex_);
  if (obstacles_) return *obstacles_;
  Piece piece;
  if (!scene_.obstacles.empty()) {
    std::vector<view::Layer> layers = planner::layers_of(
        {{"obstacles", unite_all(scene_.obstacles, monitor), planner::kObstaclesColor, planner::kObstaclesOpacity}});
    piece.id = piece_;
    piece.source = layers[0].scene.source;
    piece.scene = std::make_shared<const std::string>(view::page_scene(layers, {.details = false}));
  }
  obstacles_ = piece;
  return piece;
}

Polyhedron RestingScene::free_positions(const Monitor& monitor) {
  const std::lock_guard lock(mutex_);
  if (!free_) free_ = planner::free_positions(scene_, monitor);
  return *free_;
}

ScenePointer SceneCache::scene(const RootFolder& root, const std::string& text, const std::string& folder,
                               const Monitor& monitor) {
  if (std::optional<ScenePointer> kept = scenes_.find({text, folder})) return *kept;
  if (fs::path(folder).is_absolute()) throw InputError(folder + ": the folder of a scene is named from the root");
  std::vector<FileState> files;
  const fs::path place = root.path() / folder;
  const MeshOptions meshes = planner::scene_meshes(monitor);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  planner::Scene read;
  if (first != std::string::npos && text[first] != '{') {
    const std::string path = (place / "the scene").string();
    for (const std::string& name : planner::files_of_cfg(text, path)) {
      files.push_back(state_of_mesh(root.mesh(name, folder)));
    }
    read = planner::parse_cfg(text, path, meshes);
    for (std::string& message : read.messages) {
      if (message.starts_with(path)) message = "the scene" + message.substr(path.size());
    }
  } else {
    add_files(parse_exact_json(text, "the scene"), folder, root, files);
    read = planner::parse_scene(text, place.string(), "the scene", meshes);
  }
  ScenePointer scene = std::make_shared<const planner::Scene>(std::move(read));
  scenes_.keep({text, folder}, std::move(files), scene);
  return scene;
}

std::shared_ptr<RestingScene> SceneCache::resting(const ScenePointer& scene, const std::vector<std::size_t>& but) {
  if (auto kept = resting_.find({scene, but})) return *kept;
  auto made = std::make_shared<RestingScene>(*scene, but, numbers_.next());
  resting_.keep({scene, but}, {}, made);
  return made;
}

}  // namespace nef::studio
