// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "nef/number/number.h"

namespace nef {

/// The root of a rational number that is no less than zero, if it is rational, too.
inline std::optional<Rational> rational_square_root(const Rational& x) {
  if (mpz_perfect_square_p(x.get_num_mpz_t()) == 0 || mpz_perfect_square_p(x.get_den_mpz_t()) == 0) return {};
  return Rational(Integer(sqrt(x.get_num())), Integer(sqrt(x.get_den())));
}

}  // namespace nef
