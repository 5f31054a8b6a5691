// SPDX-License-Identifier: Apache-2.0
//
// How far the origin is inside of a sum, without the sum.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef::minkowski {

/// The point nearest to the origin that is not in a sum.
struct NearestOutside {
  Rational3 point;
  Rational squared;            ///< the square of its distance
  std::size_t facets = 0;      ///< of the reduced convolution, near the origin
  std::size_t candidates = 0;  ///< points of it that may be the nearest one
  std::size_t tested = 0;      ///< points that were put to the definition
};

/// The point outside of int A + int B that is nearest to the origin (one of them), for two open bounded sets that are
/// the interiors of their closures, neither of them empty, whose sum holds the origin. Nothing, with the reason in
/// `why`, for a few kinds of sets: two convex ones, whose sum is soon made; sizes that are not moderate
/// (has_moderate_size); edges with several wedges where neither set is convex.
/// O(n m) boxes for n and m features, pairs and triples of the facets of the convolution that come nearer to the origin
/// than the answer, and a test of membership (IntersectionQuery) for each candidate that is nearer. The monitor is told
/// of kSumPhase.
std::optional<NearestOutside> nearest_outside(const Polyhedron& a, const Polyhedron& b, std::string& why,
                                              const Monitor& monitor);

}  // namespace nef::minkowski
