// SPDX-License-Identifier: Apache-2.0
//
// Roots and their order against numbers with many digits, and arithmetic against what it must give.
#include "apps/planner/mechanism/quadratic_root.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::quadratic_root {
namespace {

// With 400 bits: far more than two different roots of small numbers can share.
mpf_class many_digits(const QuadraticRoot& x) {
  constexpr unsigned kBits = 400;
  const mpf_class rational(x.rational, kBits);
  const mpf_class square(x.square, kBits);
  return rational + x.sign * mpf_class(sqrt(square), kBits);
}

Rational small() { return ratio(*rc::gen::inRange(-12, 13), *rc::gen::inRange(1, 7)); }

QuadraticRoot root() {
  QuadraticRoot x(small());
  const Rational square = small();
  if (square <= 0) return x;
  x.square = square;
  x.sign = *rc::gen::element(-1, 1);
  return x;
}

TEST_CASE("quadratic roots are ordered as their digits are", "[mechanism]") {
  rc::check([] {
    const QuadraticRoot a = root();
    const QuadraticRoot b = *rc::gen::inRange(0, 4) == 0 ? a : root();
    const mpf_class difference(many_digits(a) - many_digits(b), 400);
    const int order = abs(difference) < mpf_class("1e-100", 400) ? 0 : sgn(difference);
    RC_ASSERT(compare(a, b) == order);
    RC_ASSERT(compare(b, a) == -order);
    for (const unsigned bits : {4U, 60U}) {
      const std::array<Rational, 2> around = enclosure(a, bits);
      RC_ASSERT(compare(a, around[0]) >= 0);
      RC_ASSERT(compare(a, around[1]) <= 0);
      Rational most(1);
      mpq_div_2exp(most.get_mpq_t(), most.get_mpq_t(), bits);
      RC_ASSERT(around[1] - around[0] <= most);
    }
  });
}

TEST_CASE("roots of a quadratic polynomial are all its zeros in the unit interval", "[mechanism]") {
  rc::check([] {
    const std::array<Rational, 3> c{small(), small(), small()};
    const std::vector<QuadraticRoot> roots = roots_in_unit_interval(c);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const Surd x = Surd::of(roots[i]);
      RC_ASSERT((Surd(c[0]) + x * (Surd(c[1]) + x * Surd(c[2]))).sign() == 0);
      RC_ASSERT(compare(roots[i], Rational(0)) >= 0);
      RC_ASSERT(compare(roots[i], Rational(1)) <= 0);
      if (i > 0) RC_ASSERT(compare(roots[i - 1], roots[i]) < 0);
    }
    // Between the roots, and beyond them, there is one sign.
    std::vector<int> signs;
    std::size_t next = 0;
    int last = 0;
    for (int k = 0; k <= 64; ++k) {
      const Rational at = ratio(k, 64);
      while (next < roots.size() && compare(roots[next], at) <= 0) {
        ++next;
        last = 0;
      }
      const Rational value = c[0] + at * (c[1] + at * c[2]);
      if (value == 0) continue;
      RC_ASSERT((last == 0 || sgn(value) == last));
      last = sgn(value);
    }
  });
}

TEST_CASE("arithmetic with a root agrees with that of digits", "[mechanism]") {
  rc::check([] {
    const QuadraticRoot x = root();
    const Rational a = small();
    const Rational b = small();
    const Surd s = Surd::of(x);
    const mpf_class d = many_digits(x);
    const auto sign_of = [](const mpf_class& value) { return abs(value) < mpf_class("1e-90", 400) ? 0 : sgn(value); };
    const mpf_class fa(a, 400);
    const mpf_class fb(b, 400);
    const Surd product = (s + Surd(a)) * (s - Surd(b));
    RC_ASSERT(product.sign() == sign_of(mpf_class((d + fa) * (d - fb), 400)));
    const Surd divisor = s - Surd(b);
    if (divisor.sign() == 0) return;
    RC_ASSERT((product / divisor - s - Surd(a)).sign() == 0);
    RC_ASSERT((Surd(a) / divisor).sign() == sign_of(mpf_class(fa / (d - fb), 400)));
  });
}

}  // namespace
}  // namespace nef::planner::test::quadratic_root
