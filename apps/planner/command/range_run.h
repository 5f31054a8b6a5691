// SPDX-License-Identifier: Apache-2.0
//
// `planner --range MECHANISM.json`: the range of motion of a joint.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/planner/command/arguments.h"
#include "apps/planner/mechanism/range_of_motion.h"

namespace nef::planner {

/// Reads the mechanism, finds its range of motion, writes and prints what was asked for. Returns the exit code: 0, or 5
/// if a part of the range is undecided. Throws nef::Error for bad input.
int run_range(const Arguments& arguments);

/// The keys of a report: joint, parts.
nlohmann::json range_json(const RangeOfMotion& range, const Mechanism& mechanism);

}  // namespace nef::planner
