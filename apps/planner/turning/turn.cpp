// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turn.h"

#include <algorithm>
#include <cmath>

#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

Integer floor_of(const Rational& x) {
  Integer result;
  mpz_fdiv_q(result.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return result;
}

}  // namespace

Direction2 direction_of(const Turn& turn) {
  const Integer quarter = floor_of(turn);
  const Rational t = turn - quarter;
  const Rational square = t * t;
  Direction2 d{(1 - square) / (1 + square), 2 * t / (1 + square)};
  for (Integer k = quarter % 4 + 4; k % 4 != 0; --k) d = {-d.sine, d.cosine};
  return d;
}

Rational half_tangent_between(const Turn& a, const Turn& b) {
  const Integer quarter = floor_of(a);
  const Rational ta = a - quarter;
  const Rational tb = b - quarter;  // 1 at the end of the quarter
  return (tb - ta) / (1 + ta * tb);
}

Turn turn_of_degrees(const Rational& degrees) {
  const Integer quarter = floor_of(degrees / 90);
  const Rational rest = degrees - 90 * quarter;
  if (rest == 0) return Turn(quarter);
  const double t = std::tan(nearest_double(rest) * M_PI / 360);
  const Rational low = std::max(Rational(0), Rational(exact_rational(t) - exact_rational(1e-12)));
  return quarter + simplest_between(low, exact_rational(t) + exact_rational(1e-12));
}

double degrees_of(const Turn& turn) {
  const Integer quarter = floor_of(turn);
  return 90 * quarter.get_d() + 360 / M_PI * std::atan(nearest_double(turn - quarter));
}

std::optional<Turn> turn_of_vector(const Rational& x, const Rational& y) {
  if (x == 0 && y == 0) return std::nullopt;
  // Into the first quarter: then t = y / (length + x).
  Rational u = x;
  Rational v = y;
  int quarter = 0;
  while (!(u > 0 && v >= 0)) {
    const Rational w = u;
    u = v;
    v = -w;
    ++quarter;
  }
  const Rational square = u * u + v * v;
  if (mpz_perfect_square_p(square.get_num_mpz_t()) == 0 || mpz_perfect_square_p(square.get_den_mpz_t()) == 0) {
    return std::nullopt;
  }
  const Rational length(Integer(sqrt(square.get_num())), Integer(sqrt(square.get_den())));
  return Turn(quarter + v / (length + u));
}

AffineMap rotation_of(const Turn& turn, std::size_t axis) {
  AffineMap map = AffineMap::identity();
  const Direction2 d = direction_of(turn);
  const std::size_t i = (axis + 1) % 3;
  const std::size_t j = (axis + 2) % 3;
  map.linear[i][i] = d.cosine;
  map.linear[i][j] = -d.sine;
  map.linear[j][i] = d.sine;
  map.linear[j][j] = d.cosine;
  return map;
}

}  // namespace nef::planner
