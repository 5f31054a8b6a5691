// SPDX-License-Identifier: Apache-2.0
//
// The program nef_mpi, one process for each rank.
#include "apps/nef_mpi/run.h"

int main(int argc, char** argv) { return nef::mpi::run_command(argc, argv); }
