// SPDX-License-Identifier: Apache-2.0
//
// By continued fractions: [Graham, Knuth, Patashnik 1994].
#include "nef/number/simplest_between.h"

#include "nef/base/error.h"
#include "nef/number/brief_text.h"
#include "nef/number/floor.h"

namespace nef {
namespace {

// 0 < low <= high
Rational simplest_positive(const Rational& low, const Rational& high) {
  const Integer whole = floor_of(low);
  if (Rational(whole) == low) return low;
  if (Rational(whole + 1) <= high) return Rational(whole + 1);
  return whole + 1 / simplest_positive(1 / (high - whole), 1 / (low - whole));
}

}  // namespace

Rational simplest_between(const Rational& low, const Rational& high) {
  if (low > high) throw InputError("no rational lies between " + brief_text(low) + " and " + brief_text(high));
  if (sgn(low) <= 0 && sgn(high) >= 0) return 0;
  if (sgn(high) < 0) return -simplest_positive(-high, -low);
  return simplest_positive(low, high);
}

}  // namespace nef
