// SPDX-License-Identifier: Apache-2.0
//
// Roots of quadratic polynomials with rational coefficients, and exact arithmetic with them.
#pragma once

#include <array>
#include <vector>

#include "nef/number/number.h"

namespace nef::planner {

/// The number rational + sign * sqrt(square): every root of a quadratic polynomial with rational coefficients.
struct QuadraticRoot {
  Rational rational;
  Rational square = 0;  ///< not negative; 0 for rational roots
  int sign = 0;         ///< of the square root; 0 for rational roots

  QuadraticRoot() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a rational number is one
  QuadraticRoot(Rational value) : rational(std::move(value)) {}

  [[nodiscard]] bool is_rational() const { return sign == 0; }
};

/// -1, 0 or 1 as a is less than, equal to, or greater than b. Exact.
int compare(const QuadraticRoot& a, const QuadraticRoot& b);

/// The root for a + scale x in place of x. `scale` must be positive.
QuadraticRoot moved(const QuadraticRoot& x, const Rational& a, const Rational& scale);

/// Two rational numbers that enclose x, at most 2^-bits apart; equal if x is rational.
std::array<Rational, 2> enclosure(const QuadraticRoot& x, unsigned bits);

/// The roots of c[0] + c[1] x + c[2] x^2 in [0, 1], in order, double ones once; none if all coefficients are 0.
std::vector<QuadraticRoot> roots_in_unit_interval(const std::array<Rational, 3>& c);

/// A number a + b sqrt(d) of the field of one quadratic root. Operations of two numbers need the same d, which must
/// outlive them; a number without d is rational and goes with all.
class Surd {
 public:
  Surd() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a rational number is one
  Surd(Rational a) : a_(std::move(a)) {}
  Surd(Rational a, Rational b, const Rational* d) : a_(std::move(a)), b_(std::move(b)), d_(d) {}
  /// The root itself, which must outlive the result.
  static Surd of(const QuadraticRoot& x) {
    return x.is_rational() ? Surd(x.rational) : Surd(x.rational, x.sign, &x.square);
  }

  friend Surd operator+(const Surd& x, const Surd& y) { return {x.a_ + y.a_, x.b_ + y.b_, x.common(y)}; }
  friend Surd operator-(const Surd& x, const Surd& y) { return {x.a_ - y.a_, x.b_ - y.b_, x.common(y)}; }
  friend Surd operator*(const Surd& x, const Surd& y);
  /// The divisor must not be 0.
  friend Surd operator/(const Surd& x, const Surd& y);

  /// -1, 0 or 1. Exact.
  [[nodiscard]] int sign() const;

 private:
  [[nodiscard]] const Rational* common(const Surd& other) const { return d_ != nullptr ? d_ : other.d_; }

  Rational a_;
  Rational b_;
  const Rational* d_ = nullptr;
};

/// Vectors of such numbers.
using Surd3 = std::array<Surd, 3>;

}  // namespace nef::planner
