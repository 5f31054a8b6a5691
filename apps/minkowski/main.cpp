// SPDX-License-Identifier: Apache-2.0
//
// The program `minkowski`: sums, decompositions and configuration spaces of sets in files. The work is in command/.
#include "apps/minkowski/command/run.h"

int main(int argc, char** argv) { return nef::minkowski::run_command(argc, argv); }
