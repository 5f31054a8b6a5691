// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/scene_cache.h"

#include <algorithm>

#include "apps/planner/command/scene_view.h"
#include "apps/program/expression/expression.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

// The file of a name that was found below the root, without "#PART".
fs::path file_of(const RootFolder& root, const std::string& name, const std::string& folder) {
  const std::string path = root.mesh(name, folder);
  std::error_code error;
  return fs::exists(path, error) ? path : path.substr(0, path.rfind('#'));
}

// The files that a shape names, whether it is a name or an expression. They must be below the root.
void add_files(const std::string& text, const std::string& folder, const RootFolder& root,
               std::vector<fs::path>& files) {
  std::error_code error;
  if (fs::exists(root.path() / folder / text.substr(0, text.rfind('#')), error)) {
    files.push_back(file_of(root, text, folder));
    return;
  }
  std::vector<std::string> names;
  try {
    names = files_of_expression(text);
  } catch (const InputError&) {
    return;  // the reader of scenes words it
  }
  for (const std::string& name : names) files.push_back(file_of(root, name, folder));
}

void add_files(const nlohmann::json& value, const std::string& folder, const RootFolder& root,
               std::vector<fs::path>& files) {
  if (value.is_string()) add_files(value.get<std::string>(), folder, root, files);
  if (value.is_array() || value.is_object()) {
    for (const nlohmann::json& item : value) add_files(item, folder, root, files);
  }
}

}  // namespace

std::shared_ptr<const planner::Scene> SceneCache::scene(const RootFolder& root, const std::string& text,
                                                        const std::string& folder, const Monitor& monitor) {
  std::error_code error;
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.text == text && e.folder == folder &&
             std::all_of(e.files.begin(), e.files.end(),
                         [&](const ReadFile& f) { return fs::last_write_time(f.path, error) == f.written; });
    });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
      return found->scene;
    }
  }
  if (fs::path(folder).is_absolute()) throw InputError(folder + ": the folder of a scene is named from the root");
  std::vector<fs::path> files;
  add_files(parse_exact_json(text, "the scene"), folder, root, files);
  Entry entry;
  entry.text = text;
  entry.folder = folder;
  for (const fs::path& file : files) entry.files.push_back({file, fs::last_write_time(file, error)});
  entry.scene = std::make_shared<const planner::Scene>(
      planner::parse_scene(text, (root.path() / folder).string(), "the scene", planner::scene_meshes(monitor)));
  std::shared_ptr<const planner::Scene> scene = entry.scene;
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const Entry& e) { return e.text == text && e.folder == folder; });
  entries_.push_front(std::move(entry));
  if (entries_.size() > kMost) entries_.pop_back();
  return scene;
}

view::Layer SceneCache::other_obstacles(const std::shared_ptr<const planner::Scene>& scene,
                                        const std::vector<std::size_t>& but, const Monitor& monitor) {
  const auto entry_of_scene = [&] {
    return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.scene == scene; });
  };
  {
    const std::lock_guard lock(mutex_);
    const auto found = entry_of_scene();
    if (found != entries_.end() && found->others && found->but == but) return *found->others;
  }
  std::vector<Polyhedron> others;
  for (std::size_t i = 0; i < scene->obstacles.size(); ++i) {
    if (!std::binary_search(but.begin(), but.end(), i)) others.push_back(scene->obstacles[i]);
  }
  view::Layer layer = std::move(planner::layers_of({{"obstacles", unite_all(others, monitor), planner::kObstaclesColor,
                                                     planner::kObstaclesOpacity}})
                                    .front());
  const std::lock_guard lock(mutex_);
  if (const auto found = entry_of_scene(); found != entries_.end()) {
    found->but = but;
    found->others = layer;
  }
  return layer;
}

}  // namespace nef::studio
