// SPDX-License-Identifier: Apache-2.0
//
// Rational to single precision.
#pragma once

#include "nef/number/number.h"

namespace nef {

/// The float nearest to a rational (half to even), rounded once; an infinity beyond the range of float.
float nearest_float(const Rational& value);

}  // namespace nef
