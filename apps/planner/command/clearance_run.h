// SPDX-License-Identifier: Apache-2.0
//
// What the command does about clearance and time.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/planner/command/arguments.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_search.h"

namespace nef::planner {

/// Answers --widest and --widest-box: the robot of the scene becomes the widest that is known to pass (the smallest
/// that was tried if none is). Returns what to report: growth, low, high, undecided.
nlohmann::json make_widest(const Arguments& arguments, Scene& scene);
/// The same for people.
std::string widest_text(const nlohmann::json& widest);

}  // namespace nef::planner
