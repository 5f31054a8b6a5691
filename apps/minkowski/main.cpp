// SPDX-License-Identifier: Apache-2.0
//
// The program `minkowski`: sums, decompositions and configuration spaces of sets in files. The work is in command/.
#include "apps/minkowski/command/run.h"
#include "nef/base/freed_memory.h"

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  return nef::minkowski::run_command(argc, argv);
}
