// SPDX-License-Identifier: Apache-2.0
//
// Have two convex sets a point in common? Exactly, for what filters leave open.
#pragma once

#include <span>

#include "nef/number/number.h"

namespace nef::planner {

/// With `closed`, true if the hulls of two sets of points have no point in common; else, if the interior of their set
/// of differences does not hold the origin: then a plane lies between them, which they may touch. (Two solids overlap
/// iff there is none.) O(n m log(n m)) expected for n and m points, about a millisecond for a few.
bool hulls_are_apart(std::span<const Rational3> a, std::span<const Rational3> b, bool closed);

}  // namespace nef::planner
