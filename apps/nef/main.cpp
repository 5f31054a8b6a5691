// SPDX-License-Identifier: Apache-2.0
//
// The program `nef`, with Minkowski sums in its expressions.
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/nef/command/run_command.h"
#include "nef/base/freed_memory.h"

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  nef::CommandExtensions extensions;
  extensions.minkowski = [](const nef::Polyhedron& a, const nef::Polyhedron& b, const nef::Monitor& monitor) {
    return nef::minkowski::minkowski_sum(a, b, {.monitor = monitor});
  };
  extensions.ball = nef::minkowski::inner_ball;
  extensions.hull = nef::minkowski::hull;
  return nef::run_command(argc, argv, extensions);
}
