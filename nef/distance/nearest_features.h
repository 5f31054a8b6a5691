// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/number/number.h"

namespace nef {

struct NearestPair {
  Rational squared;  ///< the square of the distance
  Rational3 on_a;
  Rational3 on_b;
};

/// The nearest points of two closed bounded sets without a common point, neither of them empty. Such points lie on
/// vertices, edges or facets: a vertex and a facet, two edges, or what these have as limits. Boxes of doubles leave out
/// what is too far; what remains is computed in rationals.
NearestPair nearest_features(const Complex& a, const Complex& b, const Monitor& monitor);

/// The nearest points of two segments, which may be points: exact, whatever their position.
NearestPair nearest_of_segments(const std::array<Rational3, 2>& a, const std::array<Rational3, 2>& b);

}  // namespace nef
