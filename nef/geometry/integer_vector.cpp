// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/integer_vector.h"

namespace nef {

Integer common_denominator(const Rational3& v) {
  Integer common = v[0].get_den();
  for (std::size_t i = 1; i < 3; ++i) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), v[i].get_den_mpz_t());
  return common;
}

Integer3 times(const Rational3& v, const Integer& multiple) {
  Integer3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_divexact(result[i].get_mpz_t(), multiple.get_mpz_t(), v[i].get_den_mpz_t());
    result[i] *= v[i].get_num();
  }
  return result;
}

Integer3 primitive(const Rational3& v) { return primitive(times(v, common_denominator(v))); }

Integer3 primitive(Integer3 v) {
  const Integer divisor = gcd(gcd(v[0], v[1]), v[2]);
  if (divisor > 1) {
    for (Integer& x : v) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  }
  return v;
}

}  // namespace nef
