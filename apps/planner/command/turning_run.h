// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "apps/planner/command/arguments.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// Answers the question of a scene whose robot may turn, and prints and writes what was asked for. Returns the exit
/// code: 0 path, 1 infeasible, 3 invalid start or goal, 5 undecided. Throws InputError for options that it does not
/// know. `widest`, if not null, is reported, too.
int run_turning(const Arguments& arguments, const Scene& scene, const nlohmann::json& widest = nullptr);

}  // namespace nef::planner
