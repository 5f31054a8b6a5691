// SPDX-License-Identifier: Apache-2.0
//
// The program `planner`. The work is in the library and in command/.
#include "apps/planner/command/runs/runs.h"
#include "nef/base/freed_memory.h"

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  return nef::planner::run_command(argc, argv);
}
