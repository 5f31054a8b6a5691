// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What of an obstacle the robot may reach, however it is turned about its reference point: all of a bounded one, else
/// what is near the scene's box. Throws InputError if the obstacle is unbounded and the scene has no box.
Polyhedron reachable_part(const Polyhedron& obstacle, const Scene& scene, const Monitor& monitor);

}  // namespace nef::planner
