// SPDX-License-Identifier: Apache-2.0
//
// The tangent of half the angle between p and r is |p ^ r| / (|p| |r| + <p, r>), where |p ^ r|^2 = <p, p> <r, r> - <p,
// r>^2. Square roots come from the integer square root, arcus tangents from their series after the angle is halved
// twice, each with a bound on either side. Bounds are rounded outward on the way: exact powers would have tens of
// thousands of digits, and what is computed with the bounds after that, too.
#include "apps/planner/proofs/check/arc_time.h"

#include <algorithm>
#include <cstddef>

namespace nef::planner {
namespace {

// The next multiple of 2^-128 below or above.
Rational rounded(const Rational& x, bool upper) {
  constexpr mp_bitcnt_t kPlaces = 128;
  const Integer scaled = x.get_num() << kPlaces;
  Integer quotient;
  (upper ? mpz_cdiv_q : mpz_fdiv_q)(quotient.get_mpz_t(), scaled.get_mpz_t(), x.get_den_mpz_t());
  Rational result(quotient, Integer(1) << kPlaces);
  result.canonicalize();
  return result;
}

// A lower or upper bound of the square root, with a hundred binary places.
Rational root(const Rational& x, bool upper) {
  const auto bits = [](const Integer& n) { return static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)); };
  const long short_of = std::max(0L, 200 - bits(x.get_num()) + bits(x.get_den()));
  const auto half = static_cast<mp_bitcnt_t>((short_of + 1) / 2);
  const Integer scaled = (x.get_num() << 2 * half) / x.get_den();
  Rational result(sqrt(scaled) + (upper ? 1 : 0), Integer(1) << half);
  result.canonicalize();
  return result;
}

// A bound of the arcus tangent of x, 0 <= x <= 1.
Rational arc_tangent(Rational x, bool upper) {
  for (int halving = 0; halving < 2; ++halving) x = rounded(x / (1 + root(1 + x * x, !upper)), upper);
  // x is at most tan(pi / 16) < 1/5 now; the terms alternate and fall, so the last one says on which side the sum is.
  const Rational square = x * x;
  std::array<Rational, 2> power{x, x};  // bounds from below and from above
  Rational sum = 0;
  const int terms = upper ? 19 : 18;
  for (int k = 0; k < terms; ++k) {
    const bool is_added = k % 2 == 0;
    const Rational term = power[is_added == upper ? 1 : 0] / (2 * k + 1);
    sum += is_added ? term : Rational(-term);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      power[side] = rounded(power[side] * square, side == 1);
  }
  return rounded(4 * sum, upper);
}

// A bound of half the angle between two quaternions whose scalar product is not negative.
Rational half_angle(const Quaternion& p, const Quaternion& r, bool upper) {
  const Rational between = scalar_product(p, r);
  const Rational lengths = scalar_product(p, p) * scalar_product(r, r);
  const Rational tangent = root(lengths - between * between, upper) / (root(lengths, !upper) + between);
  return arc_tangent(std::min(tangent, Rational(1)), upper);
}

}  // namespace

std::array<Rational, 2> time_bounds(const Quaternion& p, const Quaternion& q, const Rational& s) {
  if (s == 0 || s == 1) return {s, s};
  Quaternion r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = (1 - s) * p[k] + s * q[k];
  const Rational low = rounded(half_angle(p, r, false) / half_angle(p, q, true), false);
  const Rational least = half_angle(p, q, false);
  const Rational high = least == 0 ? Rational(1) : rounded(half_angle(p, r, true) / least, true);
  return {low, std::min(high, Rational(1))};
}

}  // namespace nef::planner
