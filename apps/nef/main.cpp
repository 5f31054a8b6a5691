// SPDX-License-Identifier: Apache-2.0
//
// The program `nef`, with Minkowski sums in its expressions.
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/command/run_command.h"

int main(int argc, char** argv) {
  nef::CommandExtensions extensions;
  extensions.minkowski = [](const nef::Polyhedron& a, const nef::Polyhedron& b) {
    return nef::minkowski::minkowski_sum(a, b);
  };
  extensions.ball = [](const nef::Rational& radius, const nef::Rational& splits) {
    if (splits.get_den() != 1 || splits < 1 || splits > 64) {
      throw nef::InputError("ball(r, n): n is a whole number from 1 to 64");
    }
    const auto n = static_cast<int>(splits.get_num().get_si());
    return to_polyhedron(nef::minkowski::ball_approximation(radius, n, nef::minkowski::Side::kInner).cell);
  };
  return nef::run_command(argc, argv, extensions);
}
