// SPDX-License-Identifier: Apache-2.0
//
// The program nef_mpi, one process for each rank.
#include "apps/nef_mpi/run.h"
#include "nef/base/freed_memory.h"

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  return nef::mpi::run_command(argc, argv);
}
