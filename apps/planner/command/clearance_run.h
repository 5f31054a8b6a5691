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

/// Throws InputError for options about clearance and time that do not fit together.
void check_clearance_usage(const Arguments& arguments);

/// Answers --widest and --widest-box: the robot of the scene becomes the widest that is known to pass (the smallest
/// that was tried if none is). Returns what to report: growth, low, high, undecided.
nlohmann::json make_widest(const Arguments& arguments, Scene& scene);
/// The same for people.
std::string widest_text(const nlohmann::json& widest);

/// Seconds at which each way-point is reached.
std::vector<double> times_along(const ExactPath& path, const MotionLimits& limits);
/// The same for a robot that turns: an angle counts as the way of the robot's farthest corner.
std::vector<double> times_along(const std::vector<Pose>& path, const Scene& scene, const TurningAxis& axis,
                                const MotionLimits& limits);

}  // namespace nef::planner
