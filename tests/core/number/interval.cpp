// SPDX-License-Identifier: Apache-2.0
//
// Intervals hold what rationals say, near the ends of what doubles hold, too.
#include "nef/number/interval.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/number/number.h"

namespace nef {
namespace {

bool holds(const Interval& interval, const Rational& x) {
  const bool above = !std::isfinite(interval.low()) || exact_rational(interval.low()) <= x;
  const bool below = !std::isfinite(interval.high()) || x <= exact_rational(interval.high());
  return above && below;
}

}  // namespace

TEST_CASE("Intervals hold the results of exact arithmetic", "[interval]") {
  std::mt19937_64 random(3);
  const auto number = [&] {
    const double mantissa = std::ldexp(static_cast<double>(random() >> 11U), -53) * (random() % 2 == 0 ? 1 : -1);
    const int size = std::array{0, 3, 60, 500, 1020, -500, -1030, -1070}[random() % 8];
    return std::ldexp(random() % 8 == 0 ? std::copysign(0.5, mantissa) : mantissa, size);
  };
  for (int round = 0; round < 20000; ++round) {
    const double a = number();
    const double b = number();
    const Rational p = exact_rational(a);
    const Rational q = exact_rational(b);
    CAPTURE(a, b);
    REQUIRE(holds(Interval(a) + Interval(b), p + q));
    REQUIRE(holds(Interval(a) - Interval(b), p - q));
    REQUIRE(holds(Interval(a) * Interval(b), p * q));
    if (b != 0) REQUIRE(holds(Interval(a) / Interval(b), p / q));
    const Interval root = sqrt(Interval(std::fabs(a)));
    REQUIRE(exact_rational(root.low()) * exact_rational(root.low()) <= abs(p));
    if (std::isfinite(root.high())) REQUIRE(exact_rational(root.high()) * exact_rational(root.high()) >= abs(p));
    // A chain of operations on intervals that are not numbers.
    const Interval wide = Interval(a) * Interval(b) - Interval(b) * Interval(0.1);
    REQUIRE(
        holds(wide * wide + Interval(a), (p * q - q * exact_rational(0.1)) * (p * q - q * exact_rational(0.1)) + p));
    if (!std::isfinite(wide.radius())) continue;
    REQUIRE(abs(exact_rational(wide.middle()) - (p * q - q * exact_rational(0.1))) <= exact_rational(wide.radius()));
  }
}

}  // namespace nef
