// SPDX-License-Identifier: Apache-2.0
//
// From a forbidden position to its reason.
#pragma once

#include <optional>
#include <string>

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What a robot at a forbidden position hits.
struct Collision {
  bool outside_box = false;
  std::size_t obstacle = 0;  ///< index into scene.obstacles
  Location cell;             ///< of the obstacle
  Rational3 point;           ///< in the overlap, in the workspace
};
/// Nothing if the position is free after all.
std::optional<Collision> find_collision(const Scene& scene, const Rational3& position, const Monitor& monitor = {});

/// "obstacle 2 (wall.off), facet 3, at (1, 0, 1/2)".
std::string describe(const Collision& collision, const Scene& scene);

}  // namespace nef::planner
