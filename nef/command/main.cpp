// SPDX-License-Identifier: Apache-2.0
//
// The program `nef` of a build without the applications; apps/nef/main.cpp is the one with them.
#include "nef/command/run_command.h"

int main(int argc, char** argv) { return nef::run_command(argc, argv); }
