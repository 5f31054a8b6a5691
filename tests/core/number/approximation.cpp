// SPDX-License-Identifier: Apache-2.0
//
// Doubles that know how far off they may be, against rational arithmetic.
#include "nef/number/approximation.h"

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace {

using nef::Approximation;
using nef::exact_rational;
using nef::Rational;

// A number and an approximation of it: of any size down to the smallest doubles, off by all, a part or nothing of what
// it says.
struct Approximated {
  Approximation rough;
  Rational truth;
};

rc::Gen<Approximated> approximated() {
  const auto exponent = rc::gen::oneOf(rc::gen::inRange(-30, 30), rc::gen::inRange(-1070, 400));
  return rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(-(1 << 30), 1 << 30), exponent, rc::gen::inRange(0, 60), rc::gen::inRange(-4, 5)),
      [](const std::tuple<int, int, int, int>& parts) {
        const auto [mantissa, power, below, part] = parts;
        const double value = std::ldexp(mantissa, power - 30);
        const double error = below == 0 ? 0 : std::ldexp(std::fabs(value), -below);
        return Approximated{{value, error}, exact_rational(value) + exact_rational(error) * Rational(part) / 4};
      });
}

void check_holds(const Approximation& rough, const Rational& truth) {
  if (!std::isfinite(rough.value) || !std::isfinite(rough.error)) {
    RC_ASSERT(!rough.sign());
    return;
  }
  RC_ASSERT(abs(Rational(exact_rational(rough.value) - truth)) <= exact_rational(rough.error));
  if (const std::optional<int> sign = rough.sign()) RC_ASSERT(*sign == sgn(truth));
}

}  // namespace

TEST_CASE("Approximations hold what they stand for through sums, products and quotients", "[approximation]") {
  rc::prop("", [] {
    const Approximated a = *approximated();
    const Approximated b = *approximated();
    check_holds(a.rough, a.truth);
    check_holds(-a.rough, -a.truth);
    check_holds(a.rough + b.rough, a.truth + b.truth);
    check_holds(a.rough - b.rough, a.truth - b.truth);
    check_holds(a.rough * b.rough, a.truth * b.truth);
    if (b.truth != 0) check_holds(a.rough / b.rough, a.truth / b.truth);
    const Approximated c = *approximated();
    check_holds(a.rough * b.rough - b.rough * c.rough, a.truth * b.truth - b.truth * c.truth);
  });
}

TEST_CASE("The sign of an approximation tells zero from not known", "[approximation]") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(Approximation{2, 1}.sign() == 1);
  CHECK(Approximation{-2, 1}.sign() == -1);
  CHECK(Approximation{0, 0}.sign() == 0);
  CHECK_FALSE(Approximation{0, 1e-300}.sign());
  CHECK_FALSE(Approximation{1, 1}.sign());
  CHECK_FALSE(Approximation{kInfinity, kInfinity}.sign());
  CHECK_FALSE(Approximation{kNan, 0}.sign());
  CHECK_FALSE(Approximation{1, kNan}.sign());
  CHECK_FALSE((Approximation{1, 0} / Approximation{0.5, 0.5}).sign());
}

TEST_CASE("The ladder asks the exact question only where doubles do not tell, and counts", "[approximation][fast]") {
  nef::PredicateCounts counts;
  const nef::Monitor monitor = nef::Monitor().counting(counts);
  int asked = 0;
  const auto exact = [&asked] {
    ++asked;
    return -1;
  };
  CHECK(nef::sign_by_ladder({3, 1}, monitor, exact) == 1);
  CHECK(asked == 0);
  CHECK(nef::sign_by_ladder({1, 3}, monitor, exact) == -1);
  CHECK(asked == 1);
  CHECK(counts.filter == 1);
  CHECK(counts.exact == 1);
}
