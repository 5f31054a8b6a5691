// SPDX-License-Identifier: Apache-2.0
//
// Convex polytopes as half-spaces; have two of them a point in common? Exactly, for what filters leave open.
#pragma once

#include <span>
#include <vector>

#include "nef/mesh/mesh.h"
#include "nef/number/number.h"

namespace nef::planner {

/// Where normal * x <= offset; the normal has any length.
struct HalfSpace {
  Rational3 normal;
  Rational offset;
};

/// Those of the faces of a convex polytope, normals outward, in their order. O(faces).
std::vector<HalfSpace> half_spaces_of(const Mesh& polytope);

/// With `closed`, true if the hulls of two sets of points have no point in common; else, if the interior of their set
/// of differences does not hold the origin: then a plane lies between them, which they may touch. (Two solids overlap
/// iff there is none.) O(n m log(n m)) expected for n and m points, about a millisecond for a few.
bool hulls_are_apart(std::span<const Rational3> a, std::span<const Rational3> b, bool closed);

}  // namespace nef::planner
