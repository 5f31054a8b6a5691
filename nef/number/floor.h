// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/number/number.h"

namespace nef {

/// The largest integer that is at most x.
inline Integer floor_of(const Rational& x) {
  Integer result;
  mpz_fdiv_q(result.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return result;
}

/// The smallest integer that is at least x.
inline Integer ceiling_of(const Rational& x) {
  Integer result;
  mpz_cdiv_q(result.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return result;
}

}  // namespace nef
