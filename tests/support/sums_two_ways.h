// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums by either strategy, for tests that compare them.
#pragma once

#include <catch2/catch.hpp>

#include "apps/minkowski/minkowski.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace nef::test {

/// By convolution, checked to be valid and made without cells.
inline Polyhedron convolution(const Polyhedron& a, const Polyhedron& b) {
  minkowski::MinkowskiOptions options;
  options.strategy = minkowski::UnionStrategy::kConvolution;
  minkowski::MinkowskiReport report;
  Polyhedron sum = valid(minkowski::minkowski_sum(a, b, options, &report), "sum");
  CHECK(report.cells_a == 0);  // nothing was decomposed
  return sum;
}

/// By cells, united by the queue.
inline Polyhedron by_cells(const Polyhedron& a, const Polyhedron& b) {
  minkowski::MinkowskiOptions options;
  options.strategy = minkowski::UnionStrategy::kQueue;
  return minkowski::minkowski_sum(a, b, options);
}

}  // namespace nef::test
