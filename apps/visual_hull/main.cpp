// SPDX-License-Identifier: Apache-2.0
//
// visual_hull SCENE [options]: the exact visual hull of calibrated silhouettes. The work is in the library and in
// command/.
#include "apps/visual_hull/command/run.h"
#include "nef/base/freed_memory.h"

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  return nef::visual_hull::run_command(argc, argv);
}
