// SPDX-License-Identifier: Apache-2.0
//
// The nearest double by its definition: no neighbour is nearer, and of two equally near ones it is the even one.
#include <rapidcheck.h>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "nef/number/nearest_quotient.h"
#include "nef/number/number.h"

namespace nef {
namespace {

bool is_nearest(const Rational& value, double d) {
  if (!std::isfinite(d)) return false;
  const Rational off = abs(value - Rational(d));
  for (const double other : {std::nextafter(d, -HUGE_VAL), std::nextafter(d, HUGE_VAL)}) {
    if (!std::isfinite(other)) continue;
    const Rational its = abs(value - Rational(other));
    if (its < off) return false;
    if (its == off && (std::bit_cast<std::uint64_t>(d) & 1U) != 0) return false;
  }
  return true;
}

Integer random_integer(int bits) {
  Integer result = 1;
  for (int i = 1; i < bits; ++i) result = 2 * result + *rc::gen::inRange(0, 2);
  return result;
}

}  // namespace

TEST_CASE("the nearest double") {
  CHECK(rc::check("quotients", [] {
    // Around the lengths at which the way to compute it changes.
    Rational value(random_integer(*rc::gen::element(1, 20, 52, 53, 54, 55, 70)),
                   random_integer(*rc::gen::element(1, 20, 52, 53, 54, 55, 70)));
    value.canonicalize();
    if (*rc::gen::arbitrary<bool>()) value = -value;
    RC_ASSERT(is_nearest(value, nearest_double(value)));
  }));
  CHECK(rc::check("dyadic numbers, down to where they vanish", [] {
    Rational value(random_integer(*rc::gen::element(1, 20, 52, 53, 54, 55, 70)));
    mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(),
                 *rc::gen::element(1UL, 52UL, 53UL, 60UL, 1000UL, 1074UL, 1080UL, 1120UL, 1127UL));
    RC_ASSERT(is_nearest(value, nearest_double(value)));
  }));
  CHECK(rc::check("long quotients, not in lowest terms", [] {
    const Integer numerator = random_integer(*rc::gen::inRange(1, 400));
    const Integer denominator = random_integer(*rc::gen::inRange(1, 400));
    const Integer factor = random_integer(*rc::gen::element(1, 30, 64, 200));
    const Rational value(numerator, denominator);
    Rational lowest = value;
    lowest.canonicalize();
    const Integer n = -numerator * factor;
    const Integer d = denominator * factor;
    RC_ASSERT(is_nearest(lowest, nearest_quotient(value.get_num_mpz_t(), value.get_den_mpz_t())));
    RC_ASSERT(is_nearest(-lowest, nearest_quotient(n.get_mpz_t(), d.get_mpz_t())));
  }));
  CHECK(rc::check("half way between two doubles, and next to it", [] {
    // (2 m + 1) / 2 of 54 bits, a little more or less, over and times something long.
    Integer middle = (random_integer(53) << 1U) + 1;
    const Integer factor = random_integer(*rc::gen::element(1, 40, 64, 65, 130));
    middle *= factor;
    middle <<= 200;
    middle += *rc::gen::element(-1, 0, 1);
    Integer denominator = factor << 150;
    denominator += *rc::gen::element(-1, 0, 1);
    Rational lowest(middle, denominator);
    lowest.canonicalize();
    RC_ASSERT(is_nearest(lowest, nearest_quotient(middle.get_mpz_t(), denominator.get_mpz_t())));
  }));
  CHECK(rc::check("doubles are themselves", [] {
    const auto d = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
    if (std::isfinite(d)) RC_ASSERT(nearest_double(Rational(d)) == d);
  }));
  CHECK(nearest_double(Rational(std::numeric_limits<double>::denorm_min())) ==
        std::numeric_limits<double>::denorm_min());
  Rational tiny(1);
  mpq_div_2exp(tiny.get_mpq_t(), tiny.get_mpq_t(), 200000);
  CHECK(nearest_double(tiny) == 0);
}

}  // namespace nef
