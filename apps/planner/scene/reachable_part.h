// SPDX-License-Identifier: Apache-2.0
//
// What a robot can reach of an unbounded obstacle.
#pragma once

#include <string>

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What of an obstacle the robot may reach, however it is turned about its reference point: all of a bounded one, else
/// what is near the scene's box, cut far enough off that the cuts stay away from the robot. Throws InputError, which
/// begins with `name`, if the obstacle is unbounded and the scene has no box.
Polyhedron reachable_part(const Polyhedron& obstacle, const Scene& scene, const Monitor& monitor,
                          const std::string& name = "an obstacle");

}  // namespace nef::planner
