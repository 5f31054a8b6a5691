// SPDX-License-Identifier: Apache-2.0
//
// `planner SCENE --path FILE` for a path whose poses are turned.
#pragma once

#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// Certifies a path of the scene's robot, prints and writes what was found, and returns the exit code: 0 every motion
/// is free, 1 one collides, 5 undecided.
int run_certify(const Arguments& a, const Scene& scene, const std::vector<RigidPose>& poses);

}  // namespace nef::planner
