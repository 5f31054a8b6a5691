// SPDX-License-Identifier: Apache-2.0
//
// Vectors of rationals: for construction, where few are needed. Predicates on many points have tables of their own.
#pragma once

#include "nef/number/number.h"

namespace nef {

inline Rational3 minus(const Rational3& a, const Rational3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

inline Rational dot(const Rational3& a, const Rational3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline bool is_zero(const Rational3& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

}  // namespace nef
