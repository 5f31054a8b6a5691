// SPDX-License-Identifier: Apache-2.0
//
// Scenes of the planner, kept while somebody drags a part of one: neither its text and its meshes nor what is known of
// the obstacles that stay where they are need to be read, united, drawn and summed at each step.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/planner/scene/scene.h"
#include "apps/studio/caches/recently_used.h"
#include "apps/studio/root/root_folder.h"
#include "apps/studio/tiles/piece.h"
#include "nef/base/monitor.h"

namespace nef::studio {

using ScenePointer = std::shared_ptr<const planner::Scene>;

/// A scene without some of its obstacles. What is made of it is made when it is asked for first; any number of threads
/// may ask.
class RestingScene {
 public:
  /// `but`: the numbers of the obstacles that are left out, ascending.
  RestingScene(const planner::Scene& scene, const std::vector<std::size_t>& but, std::uint64_t piece);

  [[nodiscard]] const planner::Scene& scene() const { return scene_; }
  /// The obstacles as one layer; without a scene if there are none.
  Piece obstacles(const Monitor& monitor);
  /// The free positions among them.
  Polyhedron free_positions(const Monitor& monitor);

 private:
  planner::Scene scene_;
  std::uint64_t piece_;
  std::mutex mutex_;
  std::optional<Piece> obstacles_;
  std::optional<Polyhedron> free_;
};

class SceneCache {
 public:
  explicit SceneCache(PieceNumbers& numbers) : numbers_(numbers) {}

  /// The scene of a text whose names of files begin in a folder relative to the root. Throws InputError for anything
  /// that parse_scene refuses, and for a file that is not below the root. Any number of threads may call it.
  ScenePointer scene(const RootFolder& root, const std::string& text, const std::string& folder,
                     const Monitor& monitor);

  /// Such a scene without some obstacles (by their numbers, ascending): the same one as long as these are the same.
  std::shared_ptr<RestingScene> resting(const ScenePointer& scene, const std::vector<std::size_t>& but);

 private:
  PieceNumbers& numbers_;
  RecentlyUsed<std::pair<std::string, std::string>, ScenePointer> scenes_{4};
  RecentlyUsed<std::pair<ScenePointer, std::vector<std::size_t>>, std::shared_ptr<RestingScene>> resting_{4};
};

}  // namespace nef::studio
