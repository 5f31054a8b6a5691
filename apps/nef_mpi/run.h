// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nef::mpi {

/// The program `nef_mpi`, run on each rank: its arguments in, files and, on rank 0, standard output; the exit code.
int run_command(int argc, char** argv);

}  // namespace nef::mpi
