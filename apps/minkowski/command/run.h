// SPDX-License-Identifier: Apache-2.0
//
// The tasks of the program `minkowski`.
#pragma once

#include "apps/minkowski/command/arguments.h"

namespace nef::minkowski {

/// Reads the operands, does the task, writes result and report. Notes go to stderr. Throws Error.
void run(const Arguments& arguments);

}  // namespace nef::minkowski
