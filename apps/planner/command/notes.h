// SPDX-License-Identifier: Apache-2.0
//
// Notes about the input, on stderr.
#pragma once

#include "apps/planner/command/arguments.h"
#include "nef/construct/construct.h"

namespace nef::planner {

/// Prints each message as a line "planner: note: ..." on stderr, the first few of very many; nothing with --quiet.
void print_notes(const Arguments& a, const Messages& messages);

}  // namespace nef::planner
