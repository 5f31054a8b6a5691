// SPDX-License-Identifier: Apache-2.0
//
// Angles whose rotations are rational.
#pragma once

#include <optional>

#include "nef/polyhedron.h"

namespace nef::planner {

/// An angle about one axis as a number of quarter turns plus the tangent of half of what is left: u = q + t stands for
/// q * 90 degrees + 2 atan(t), q whole, 0 <= t < 1. Greater u, greater angle; sine and cosine are rational.
using Turn = Rational;

/// Cosine and sine.
struct Direction2 {
  Rational cosine;
  Rational sine;
};
Direction2 direction_of(const Turn& turn);

/// The tangent of half the angle from a to b. Both must lie within one quarter [q, q + 1], a <= b.
Rational half_tangent_between(const Turn& a, const Turn& b);

/// The turn of `degrees`: exact for multiples of 90, else the simplest within 1e-12 of the half-tangent.
Turn turn_of_degrees(const Rational& degrees);
/// For people.
double degrees_of(const Turn& turn);
/// The turn with the given direction, if that is rational in u: the vector (x, y) must have a rational length.
std::optional<Turn> turn_of_vector(const Rational& x, const Rational& y);

/// The rotation about coordinate axis `axis` (0 to 2) through the origin.
AffineMap rotation_of(const Turn& turn, std::size_t axis);

}  // namespace nef::planner
