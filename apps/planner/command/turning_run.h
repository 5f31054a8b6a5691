// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/planner/command/arguments.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// Answers the question of a scene whose robot may turn, and prints and writes what was asked for. Returns the exit
/// code: 0 path, 1 infeasible, 3 invalid start or goal, 5 undecided. Throws InputError for options that it does not
/// know.
int run_turning(const Arguments& arguments, const Scene& scene);

}  // namespace nef::planner
