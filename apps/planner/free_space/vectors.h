// SPDX-License-Identifier: Apache-2.0
//
// Vectors of doubles, for lengths and guesses. Nothing that must be exact goes through them.
#pragma once

#include <array>
#include <cmath>

#include "nef/number/number.h"

namespace nef::planner {

using Vector = std::array<double, 3>;

/// Each coordinate rounded to the nearest double.
inline Vector to_double(const Rational3& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// The distance of two points.
inline double span(const Vector& a, const Vector& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace nef::planner
