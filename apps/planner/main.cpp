// SPDX-License-Identifier: Apache-2.0
//
// The program `planner`. The work is in the library and in command/.
#include "apps/planner/command/run.h"

int main(int argc, char** argv) { return nef::planner::run_command(argc, argv); }
