// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::planner {

/// The program `planner`: reads the scene, answers the question, writes and prints what was asked for; errors go to
/// stderr as one line. The exit code is the one that the answer has in docs/planner.md, or 2 for bad input or usage.
int run_command(int argc, char** argv);

}  // namespace nef::planner
