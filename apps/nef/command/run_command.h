// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef {

/// What the program `nef` can do with the applications, which the core knows nothing of.
struct CommandExtensions {
  /// minkowski(A, B) in expressions and .csg files; refused where there is none.
  std::function<Polyhedron(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)> minkowski;
  /// ball(r, n) in expressions; refused where there is none.
  std::function<Polyhedron(const Rational& radius, const Rational& splits, const Monitor& monitor)> ball;
  /// hull(A) of unbounded sets in expressions; refused where there is none.
  std::function<Polyhedron(const Polyhedron& unbounded, const Monitor& monitor)> hull;
};

/// The program `nef`: its arguments in, files, standard output and the exit code out. All work is in the subcommands
/// (command_*.cpp).
int run_command(int argc, char** argv, const CommandExtensions& extensions = {});

}  // namespace nef
