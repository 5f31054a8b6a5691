// SPDX-License-Identifier: Apache-2.0
//
// Sums of sets with a bounded complement, as they come up in erosions: A eroded by B is the complement of
// complement(A) + -B.
#pragma once

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// True if the complement of a set is bounded. O(1).
bool is_cobounded(const Polyhedron& a);

/// What a sum A + B has to look at if the complement of A is bounded, and B is, too.
struct NearHoles {
  Polyhedron part;    ///< A within a box around its holes: a bounded set
  Polyhedron beyond;  ///< A + B = (part + B) united with this, the outside of a smaller box
};

/// Takes the part of A that matters: x is missing from A + B iff all of x - B lies in holes of A, so a sum inside a box
/// around the holes will do, for the price of a bounded one. A is not all of space, B is not empty. O(n).
NearHoles near_holes(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor);

}  // namespace nef::minkowski
