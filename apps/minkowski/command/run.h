// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::minkowski {

/// The program `minkowski`: reads the operands, does the task, writes result and report. Notes, and errors as one line,
/// go to stderr. The exit code: 0, or 2 for bad input or usage.
int run_command(int argc, char** argv);

}  // namespace nef::minkowski
