// SPDX-License-Identifier: Apache-2.0
//
// `planner --assembly`: taking an assembly apart, told and shown.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/command/arguments.h"

namespace nef::planner {

/// Reads the assembly, takes it apart, writes and prints what was asked for. Returns the exit code: 0 a sequence, 1
/// inseparable, 3 parts overlap. Throws nef::Error for bad input.
int run_assembly(const Arguments& arguments);

/// The report.
nlohmann::json assembly_json(const Disassembly& answer, const Assembly& assembly);

}  // namespace nef::planner
