// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/planner/command/arguments.h"

namespace nef::planner {

/// Reads the scene, answers the question, writes and prints what was asked for. Returns the exit code; throws
/// nef::Error for bad input.
int run(const Arguments& arguments);

}  // namespace nef::planner
