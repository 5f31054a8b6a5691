// SPDX-License-Identifier: Apache-2.0
//
// A rotation that moves all axes and keeps rational lengths.
#pragma once

#include "nef/polyhedron.h"

namespace nef::test {

/// The rotation with columns (1,2,2)/3, (2,1,-2)/3, (2,-2,1)/3.
inline AffineMap oblique_rotation() {
  AffineMap map = AffineMap::identity();
  const std::array<std::array<int, 3>, 3> rows{{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) map.linear[i][k] = Rational(rows[i][k]) / 3;
  }
  return map;
}

}  // namespace nef::test
