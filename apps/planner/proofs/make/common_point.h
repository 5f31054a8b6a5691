// SPDX-License-Identifier: Apache-2.0
//
// Two convex hulls: a point that both have, or a plane between them. Exactly, with the numbers that show it.
#pragma once

#include <optional>
#include <span>

#include "apps/planner/proofs/path_proof.h"
#include "nef/number/number.h"

namespace nef::planner {

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
