// SPDX-License-Identifier: Apache-2.0
//
// The program `planner`. The work is in the library and in command/.
#include "apps/planner/command/run.h"
#include "nef/program/run_program.h"

int main(int argc, char** argv) {
  CLI::App app("Plans the motion of a translating robot exactly: a path, or a proof that there is none.", "planner");
  app.set_version_flag("--version", std::string("planner " NEF_VERSION));
  nef::planner::Arguments arguments;
  nef::planner::declare(app, arguments);
  return nef::run_program(app, argc, argv, [&arguments] { return nef::planner::run(arguments); });
}
