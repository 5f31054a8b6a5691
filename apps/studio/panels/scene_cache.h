// SPDX-License-Identifier: Apache-2.0
//
// Scenes of the planner, kept while somebody drags a part of one: neither its text and its meshes nor the obstacles
// that stay where they are need to be read, united and triangulated at each step.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/scene/scene.h"
#include "apps/studio/root/root_folder.h"
#include "apps/view/layer.h"
#include "nef/base/monitor.h"

namespace nef::studio {

class SceneCache {
 public:
  /// The scene of a text whose names of files begin in a folder relative to the root. Throws InputError for anything
  /// that parse_scene refuses, and for a file that is not below the root. Any number of threads may call it.
  std::shared_ptr<const planner::Scene> scene(const RootFolder& root, const std::string& text,
                                              const std::string& folder, const Monitor& monitor);

  /// A layer of all obstacles of such a scene but some (by their numbers, ascending), in one. O(1) as long as these are
  /// the same as before.
  view::Layer other_obstacles(const std::shared_ptr<const planner::Scene>& scene, const std::vector<std::size_t>& but,
                              const Monitor& monitor);

 private:
  static constexpr std::size_t kMost = 4;  // the last used ones

  struct ReadFile {
    std::filesystem::path path;
    std::filesystem::file_time_type written;
  };
  struct Entry {
    std::string text;
    std::string folder;
    std::vector<ReadFile> files;
    std::shared_ptr<const planner::Scene> scene;
    std::vector<std::size_t> but;
    std::optional<view::Layer> others;  ///< of `but`
  };

  std::mutex mutex_;
  std::list<Entry> entries_;
};

}  // namespace nef::studio
