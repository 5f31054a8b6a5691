// SPDX-License-Identifier: Apache-2.0
//
// Quotients of integers to doubles.
#pragma once

#include <gmp.h>

namespace nef {

/// The double nearest to numerator / denominator, denominator > 0, not necessarily in lowest terms: as nearest_double.
/// Some nanoseconds, whatever the size of the integers, but for quotients that are nearly half way between two doubles.
double nearest_quotient(mpz_srcptr numerator, mpz_srcptr denominator);

}  // namespace nef
