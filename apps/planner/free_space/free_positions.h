// SPDX-License-Identifier: Apache-2.0
//
// From a scene to the free positions of its robot.
#pragma once

#include <optional>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/sum/fixed_obstacles.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// The free positions of the robot's reference point. If contact is forbidden, an open set (but for the faces of the
/// box). If it is allowed, a closed one where robot or obstacles are solid; a surface, curve or point may touch another
/// one with its border only, and there the set is neither. Robot and obstacles are taken closed. Throws InputError for
/// a robot that turns: reset the rotation of a copy to ask about one orientation.
Polyhedron free_positions(const Scene& scene, const Monitor& monitor = {});

/// The obstacles of a scene, cut up once for the free positions of many solid robots: for the scene's robot turned in
/// any way about its reference point, and what is smaller. Throws InputError as free_positions does.
minkowski::FixedObstacles fixed_obstacles(const Scene& scene, const Monitor& monitor = {});

/// An obstacle came, went, or became another set.
struct ObstacleChange {
  std::optional<std::size_t> index = std::nullopt;    ///< of the one that went or changed; one that comes is the last
  std::optional<Polyhedron> obstacle = std::nullopt;  ///< what came, or what it became
};

/// Makes the change in the scene.
void apply(const ObstacleChange& change, Scene& scene);

/// True if `free_positions_after` knows what to do: each obstacle forbids what it forbids alone. (A thin robot among
/// obstacles that it may touch is also kept out of the seams between them.)
bool obstacles_are_independent(const Scene& scene);

/// The free positions after a change, from those before it, `free`: one operation with all of free space, and the sums
/// of the obstacle before and after, and of those that may forbid the same positions. `scene` is the one before; its
/// obstacles must be independent.
Polyhedron free_positions_after(const ObstacleChange& change, const Scene& scene, const Polyhedron& free,
                                const Monitor& monitor = {});

}  // namespace nef::planner
