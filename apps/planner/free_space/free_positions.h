// SPDX-License-Identifier: Apache-2.0
//
// From a scene to the free positions of its robot.
#pragma once

#include <functional>
#include <string>

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Called with what is being done and how much of it is done; a total of 0 means that it is not known. From one thread
/// at a time.
using Progress = std::function<void(const std::string& phase, std::size_t done, std::size_t total)>;

/// How a free space is computed.
struct BuildOptions {
  Progress progress;  ///< may be empty
  /// If set, asked now and then; once it says true, free_positions throws Interrupted.
  std::function<bool()> stop;
  Monitor monitor = {};  ///< who watches, too; what it refers to must outlive the call
};

/// The free positions of the robot's reference point. If contact is forbidden, an open set (but for the faces of the
/// box). If it is allowed, a closed one where robot or obstacles are solid; a surface, curve or point may touch another
/// one with its border only, and there the set is neither. Robot and obstacles are taken closed. Throws InputError for
/// a robot that turns, as all functions here do: reset the rotation of a copy to ask about one orientation.
Polyhedron free_positions(const Scene& scene, const BuildOptions& options = {});

/// True if an obstacle may come or go by the functions below: each obstacle forbids what it forbids alone. (A thin
/// robot among obstacles that it may touch is also kept out of the seams between them.)
bool obstacles_are_independent(const Scene& scene);

/// The free positions after an obstacle has come, from those before it came: one sum and one Boolean operation.
/// `scene` is the one before; its obstacles must be independent.
Polyhedron with_obstacle(const Scene& scene, const Polyhedron& free, const Polyhedron& obstacle,
                         const BuildOptions& options = {});

/// The free positions after obstacle `index` has gone, from those while it was there: the sums of this one and of those
/// that may forbid the same positions, and one operation. `scene` is the one before; its obstacles must be independent.
Polyhedron without_obstacle(const Scene& scene, const Polyhedron& free, std::size_t index,
                            const BuildOptions& options = {});

/// The free positions after obstacle `index` has become another set, `moved`: as if it went and that came, in one
/// operation with all of free space rather than two.
Polyhedron with_obstacle_moved(const Scene& scene, const Polyhedron& free, std::size_t index, const Polyhedron& moved,
                               const BuildOptions& options = {});

}  // namespace nef::planner
