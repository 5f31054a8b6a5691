// SPDX-License-Identifier: Apache-2.0
//
// Rational numbers with small denominators for angles, so that rotations are exact.
#pragma once

#include "nef/number/number.h"

namespace nef {

/// A ratio sine : cosine of half an angle, up to a common factor.
struct HalfAngle {
  Integer sine;
  Integer cosine;
};

/// Small integers s and c such that s * sqrt(length_square) / c is the tangent of half of an angle
/// within `tolerance` degrees of `degrees`; c is zero for a half-turn. `length_square` must be
/// positive, the tolerance too. Exact multiples of 90 degrees are met exactly if the length is 1.
/// A few microseconds; grows with the digits that the tolerance asks for.
HalfAngle rational_half_angle(const Rational& degrees, const Rational& tolerance, const Integer& length_square);

}  // namespace nef
