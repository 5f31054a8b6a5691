// SPDX-License-Identifier: Apache-2.0
//
// Two convex hulls: a point that both have, or a plane between them. Exactly, with the numbers that show it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef::planner {

/// Numbers that show that two hulls have a point in common, by one weight for each vertex. The weights of each hull are
/// not negative and add up to 1, and both weighted sums are the same point. If no weight is zero, the point is in the
/// relative interior of both hulls.
struct CommonPoint {
  std::vector<Rational> robot;
  std::vector<Rational> obstacle;
};

/// What shows how two hulls lie: either a common point or the normal of a plane between them.
struct HullWitness {
  std::optional<CommonPoint> common;
  Rational3 normal;  ///< without a common point: n a < n b for all points of the hulls (n a <= n b if `inside`)
};

/// A common point of the hulls of two sets of points, neither empty, or a plane between them. With `inside` the point
/// has no weight that is zero, so it is in the relative interior of both hulls; if there is none, the plane may touch
/// them. A linear program with five equations in exact numbers, by the simplex method with Bland's rule; a few pivots
/// of O(|a| + |b|) operations each, some milliseconds for fifty points.
HullWitness witness_of_hulls(std::span<const Rational3> a, std::span<const Rational3> b, bool inside);

}  // namespace nef::planner
