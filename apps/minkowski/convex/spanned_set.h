// SPDX-License-Identifier: Apache-2.0
//
// Convex sets of any dimension, bounded or not, as what they are spanned by.
#pragma once

#include <vector>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef::minkowski {

/// All convex combinations of some points (at least one) plus all combinations of some rays with factors >= 0
/// (the theorem of Minkowski and Weyl: every convex polyhedral set is of that kind).
struct SpannedSet {
  std::vector<Rational3> points;
  std::vector<Rational3> rays;  ///< not zero
};

/// The set, or its interior relative to its own dimension. The planes of its facets are those facets of the hull of all
/// points p and p + r that no ray leaves. O(n log n) expected for n such points, plus an intersection of half-spaces.
Polyhedron to_polyhedron(const SpannedSet& set, bool closed, const Monitor& monitor);

/// Planes that a set with rays is on one side of, each of which touches it, but does not hold it: all of its relative
/// boundary lies in them.
std::vector<Polyhedron> border_planes(const SpannedSet& set, const Monitor& monitor);

/// The set of the sums a + b.
SpannedSet sum_of(const SpannedSet& a, const SpannedSet& b);

}  // namespace nef::minkowski
