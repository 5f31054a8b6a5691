// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/mechanism/quadratic_root.h"

#include <algorithm>

#include "nef/number/square_root.h"

namespace nef::planner {
namespace {

// The sign of a + b sqrt(d), d not negative.
int sign_of_sum(const Rational& a, const Rational& b, const Rational& d) {
  const int of_root = d == 0 ? 0 : sgn(b);
  if (of_root == 0) return sgn(a);
  if (sgn(a) == 0 || sgn(a) == of_root) return of_root;
  const Rational difference = a * a - b * b * d;
  return sgn(difference) * sgn(a);
}

}  // namespace

int compare(const QuadraticRoot& a, const QuadraticRoot& b) {
  // Is x = (difference of the rational parts) + a's root less than b's root?
  const Rational difference = a.rational - b.rational;
  const int left = sign_of_sum(difference, a.sign, a.square);
  const int right = b.square == 0 ? 0 : b.sign;
  if (left != right) return left < right ? -1 : 1;
  if (left == 0) return 0;
  // Both have one sign: their squares tell.
  const Rational rest = difference * difference + a.square - b.square;
  return left * sign_of_sum(rest, 2 * difference * a.sign, a.square);
}

QuadraticRoot moved(const QuadraticRoot& x, const Rational& a, const Rational& scale) {
  QuadraticRoot result(a + scale * x.rational);
  result.square = scale * scale * x.square;
  result.sign = x.sign;
  return result;
}

std::array<Rational, 2> enclosure(const QuadraticRoot& x, unsigned bits) {
  if (x.is_rational()) return {x.rational, x.rational};
  // The whole part of sqrt(4^bits d), and one more.
  Integer scaled = x.square.get_num();
  mpz_mul_2exp(scaled.get_mpz_t(), scaled.get_mpz_t(), 2 * bits);
  mpz_fdiv_q(scaled.get_mpz_t(), scaled.get_mpz_t(), x.square.get_den_mpz_t());
  const Integer root = sqrt(scaled);
  Rational low(root);
  Rational high(root + 1);
  mpq_div_2exp(low.get_mpq_t(), low.get_mpq_t(), bits);
  mpq_div_2exp(high.get_mpq_t(), high.get_mpq_t(), bits);
  if (x.sign > 0) return {x.rational + low, x.rational + high};
  return {x.rational - high, x.rational - low};
}

std::vector<QuadraticRoot> roots_in_unit_interval(const std::array<Rational, 3>& c) {
  std::vector<QuadraticRoot> roots;
  const auto take = [&](QuadraticRoot root) {
    if (compare(root, Rational(0)) >= 0 && compare(root, Rational(1)) <= 0) roots.push_back(std::move(root));
  };
  if (c[2] == 0) {
    if (c[1] != 0) take(Rational(-c[0] / c[1]));
    return roots;
  }
  const Rational middle = -c[1] / (2 * c[2]);
  const Rational square = middle * middle - c[0] / c[2];
  if (square < 0) return roots;
  const std::optional<Rational> whole = rational_square_root(square);
  for (const int sign : {-1, 1}) {
    if (square == 0) {
      if (sign > 0) take(middle);
    } else if (whole) {
      take(Rational(middle + sign * *whole));
    } else {
      QuadraticRoot root(middle);
      root.square = square;
      root.sign = sign;
      take(std::move(root));
    }
  }
  return roots;
}

Surd operator*(const Surd& x, const Surd& y) {
  const Rational* d = x.common(y);
  if (d == nullptr) return {x.a_ * y.a_};
  return {x.a_ * y.a_ + x.b_ * y.b_ * *d, x.a_ * y.b_ + x.b_ * y.a_, d};
}

Surd operator/(const Surd& x, const Surd& y) {
  const Rational* d = x.common(y);
  if (d == nullptr) return {x.a_ / y.a_};
  const Rational norm = y.a_ * y.a_ - y.b_ * y.b_ * *d;
  // Not 0 unless d is a square and y = a + b sqrt(d) has the conjugate 0: then y is 2 a.
  if (norm == 0) return x * Surd(1 / (2 * y.a_));
  return x * Surd(y.a_ / norm, -y.b_ / norm, d);
}

int Surd::sign() const { return d_ == nullptr ? sgn(a_) : sign_of_sum(a_, b_, *d_); }

}  // namespace nef::planner
