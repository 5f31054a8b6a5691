// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/number/number.h"

namespace nef {

/// The rational with the smallest denominator (and among those the smallest absolute numerator)
/// in the closed interval [low, high]. The one of smallest height in the Stern-Brocot tree; takes
/// O(digits) divisions. Throws InputError if low > high.
Rational simplest_between(const Rational& low, const Rational& high);

}  // namespace nef
