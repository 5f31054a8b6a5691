// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::test {

/// A ball about the origin whose vertices are doubles: the hull of rings, so its quadrangles are split in two.
inline Polyhedron ball(double radius, int around, int high) {
  std::vector<Rational3> points{{0, 0, exact_rational(radius)}, {0, 0, exact_rational(-radius)}};
  for (int i = 1; i < high; ++i) {
    const double polar = M_PI * i / high;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * M_PI * k / around;
      points.push_back({exact_rational(radius * std::sin(polar) * std::cos(angle)),
                        exact_rational(radius * std::sin(polar) * std::sin(angle)),
                        exact_rational(radius * std::cos(polar))});
    }
  }
  return convex_hull(points);
}

}  // namespace nef::test
