// SPDX-License-Identifier: Apache-2.0
//
// Doubles that know how far off they may be, and the ladder that every filtered predicate climbs: doubles first, exact
// numbers where these leave the sign open. A predicate whose filter is a sum of products of approximations needs no
// bound of its own; one that must be faster derives a bound for all of it beside its constant.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "nef/base/fast_path.h"
#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef {

/// The unit roundoff of doubles: a result is off by at most this part of itself, unless it is below 2^-1022.
inline constexpr double kRoundingUnit = 0x1p-53;

/// A number of which a double and a bound on its distance from that double are known. Where something was infinite or
/// no number, value or error are, too, and nothing is known.
struct Approximation {
  double value = 0;
  double error = 0;

  /// The sign of the number: +1, 0 or -1, or nothing where the double does not tell. It tells 0 only if there is no
  /// error.
  [[nodiscard]] std::optional<int> sign() const {
    // Each comparison fails for what is no number, and infinities come with infinite errors.
    if (value > error) return 1;
    if (value < -error) return -1;
    if (value == 0 && error == 0) return 0;
    return std::nullopt;
  }

  [[nodiscard]] Approximation operator-() const { return {-value, error}; }
};

// In the bounds below the last factor covers that they are rounded themselves, a few operations of one unit each; what
// is lost to underflow is a few times 2^-1074, far below the last term. Sums of doubles do not underflow.

/// Off by the errors of both and one rounding.
inline Approximation operator+(const Approximation& a, const Approximation& b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + std::fabs(value) * kRoundingUnit) * (1 + 0x1p-48)};
}
inline Approximation operator-(const Approximation& a, const Approximation& b) { return a + -b; }

/// (a + d)(b + e) - a b = a e + b d + d e, and one rounding.
inline Approximation operator*(const Approximation& a, const Approximation& b) {
  const double value = a.value * b.value;
  const double moved = std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error;
  return {value, (moved + std::fabs(value) * kRoundingUnit) * (1 + 0x1p-48) + 1e-300};
}

/// (a + d) / (b + e) - a / b = (d - (a / b) e) / (b + e), and one rounding. Nothing is known if b may be zero.
inline Approximation operator/(const Approximation& a, const Approximation& b) {
  const double least = std::fabs(b.value) - b.error;
  if (!(least > 0)) return {0, std::numeric_limits<double>::infinity()};
  const double value = a.value / b.value;
  // Quotients first: a product of errors could vanish, and what divides it may be as small.
  const double moved = a.error / least + std::fabs(value) * (1 + 0x1p-50) * (b.error / least);
  return {value, (moved + std::fabs(value) * kRoundingUnit) * (1 + 0x1p-48) + 1e-300};
}

/// A rational number as the nearest double.
inline Approximation approximation_of(const Rational& x) {
  const double value = nearest_double(x);
  return {value, std::fabs(value) * kRoundingUnit + 1e-300};
}

/// A point or vector near an exact one.
using Approximation3 = std::array<Approximation, 3>;

/// The sign of a number: what its approximation tells (if fast paths are on), else what `exact()` says. Counts which of
/// the two it was.
template <typename Exact>
int sign_by_ladder(const Approximation& rough, const Monitor& monitor, Exact&& exact) {
  if (const std::optional<int> sign = kFastPaths ? rough.sign() : std::nullopt) {
    monitor.count_filter();
    return *sign;
  }
  monitor.count_exact();
  return std::forward<Exact>(exact)();
}

}  // namespace nef
