// SPDX-License-Identifier: Apache-2.0
//
// Integer vectors in the direction of rational ones.
#pragma once

#include "nef/number/number.h"

namespace nef {

/// The least common denominator of the coordinates.
Integer common_denominator(const Rational3& v);

/// The vector times a positive multiple of its common denominator: integers.
Integer3 times(const Rational3& v, const Integer& multiple);

/// The shortest integer vector in the same direction; zero for zero.
Integer3 primitive(const Rational3& v);
Integer3 primitive(Integer3 v);

/// The same vector with rational coordinates.
inline Rational3 to_rational(const Integer3& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

}  // namespace nef
