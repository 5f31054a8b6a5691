// SPDX-License-Identifier: Apache-2.0
//
// The program `minkowski`: sums, decompositions and configuration spaces of sets in files. The work
// is in the library and in command/.
#include "apps/minkowski/command/run.h"
#include "nef/program/run_program.h"

int main(int argc, char** argv) {
  CLI::App app("Exact Minkowski sums of any two polyhedral sets: minkowski A B -o OUT");
  app.name("minkowski");
  app.set_version_flag("--version", std::string("minkowski ") + NEF_VERSION);
  app.footer("Exit codes: 0 done, 2 bad input or usage.");
  nef::minkowski::Arguments arguments;
  nef::minkowski::declare(app, arguments);
  return nef::run_program(app, argc, argv, [&arguments] {
    nef::minkowski::run(arguments);
    return 0;
  });
}
