// SPDX-License-Identifier: Apache-2.0
//
// Start and goal of a scene as users write them.
#pragma once

#include <string>

#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// Gives a scene another start or goal: "x,y,z" and, if the robot turns, degrees ("x,y,z,degrees") or a quaternion
/// ("x,y,z,qw,qx,qy,qz"), which stay as they are if they are left out. An empty text changes nothing. Throws InputError
/// that begins with `option`.
void take_end(const std::string& text, const std::string& option, Scene& scene, bool is_goal);

}  // namespace nef::planner
