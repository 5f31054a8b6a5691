// SPDX-License-Identifier: Apache-2.0
//
// Interval arithmetic in doubles: enclosures of real numbers that need no error analysis of their own.
#pragma once

#include <algorithm>
#include <cmath>

namespace nef {

/// A closed interval of real numbers. Each operation returns one that holds all results for numbers of its operands.
/// Ends may be infinite; what is not a number is the whole line.
///
/// An operation of doubles rounds to nearest, so its result x is off by at most half of ulp(x), which is at most
/// 2^-52 |x| + 2^-1074 =: m. x - ulp(x) is a double, and x - m is below it, and so is x - m after rounding. So that is
/// a lower bound, and x + m an upper one. No rounding mode is changed.
class Interval {
 public:
  constexpr Interval() = default;
  /// One number, exactly.
  constexpr Interval(double value) : low_(value), high_(value) {}  // NOLINT(google-explicit-constructor): a number
  constexpr Interval(double low, double high) : low_(low), high_(high) {}

  /// All numbers within `error` of `value`.
  static Interval around(double value, double error) { return {down(value - error), up(value + error)}; }

  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  /// A number inside, and how far all others are from it at most. Infinite if an end is.
  [[nodiscard]] double middle() const { return std::isfinite(high_ - low_) ? low_ + (high_ - low_) / 2 : HUGE_VAL; }
  [[nodiscard]] double radius() const {
    return std::isfinite(high_ - low_) ? up(std::max(up(high_ - middle()), up(middle() - low_))) : HUGE_VAL;
  }

  Interval operator-() const { return {-high_, -low_}; }
  friend Interval operator+(const Interval& a, const Interval& b) {
    return checked(down(a.low_ + b.low_), up(a.high_ + b.high_));
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return checked(down(a.low_ - b.high_), up(a.high_ - b.low_));
  }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.low_ * b.low_;
    const double q = a.low_ * b.high_;
    const double r = a.high_ * b.low_;
    const double s = a.high_ * b.high_;
    if (std::isnan(p + q + r + s)) return everything();  // infinite ends
    return checked(down(std::min({p, q, r, s})), up(std::max({p, q, r, s})));
  }
  /// The whole line if the divisor holds 0.
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (b.low_ <= 0 && b.high_ >= 0) return everything();
    const double p = a.low_ / b.low_;
    const double q = a.low_ / b.high_;
    const double r = a.high_ / b.low_;
    const double s = a.high_ / b.high_;
    if (std::isnan(p + q + r + s)) return everything();
    return checked(down(std::min({p, q, r, s})), up(std::max({p, q, r, s})));
  }
  Interval& operator+=(const Interval& other) { return *this = *this + other; }

  /// Of the numbers that are not negative; roots are rounded to nearest, like the operations.
  friend Interval sqrt(const Interval& a) {
    return checked(std::max(0.0, down(std::sqrt(std::max(0.0, a.low_)))), up(std::sqrt(std::max(0.0, a.high_))));
  }

 private:
  static double down(double x) { return x - (std::fabs(x) * 0x1p-52 + 0x1p-1074); }
  static double up(double x) { return x + (std::fabs(x) * 0x1p-52 + 0x1p-1074); }
  static Interval everything() { return {-HUGE_VAL, HUGE_VAL}; }
  static Interval checked(double low, double high) { return low <= high ? Interval(low, high) : everything(); }

  double low_ = 0;
  double high_ = 0;
};

}  // namespace nef
