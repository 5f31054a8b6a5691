// SPDX-License-Identifier: Apache-2.0
//
// Bounds of times against angles that are known, and against long doubles.
#include "apps/planner/proofs/check/arc_time.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::arc_time {
namespace {

void check_bounds(const Quaternion& p, const Quaternion& q, const Rational& s, const Rational& truth) {
  const auto [low, high] = time_bounds(p, q, s);
  CHECK(low <= truth);
  CHECK(truth <= high);
  CHECK(high - low < Rational(1, Integer(1) << 50));
}

TEST_CASE("The time of half an arc, and of thirds of a right angle", "[proofs]") {
  check_bounds({1, 0, 0, 0}, {0, 1, 0, 0}, ratio(1, 2), ratio(1, 2));
  check_bounds({3, 4, 0, 0}, {0, 0, 5, 0}, ratio(1, 2), ratio(1, 2));
  check_bounds({1, 0, 0, 0}, {1, 1, 0, 0}, 0, 0);
  check_bounds({1, 0, 0, 0}, {1, 1, 0, 0}, 1, 1);
  // (1 - s, s) has the length of both ends at a quarter turn's third if s / (1 - s) = tan 30 degrees, an irrational
  // number: bounds on both sides of it enclose 1/3.
  const Rational less = ratio(36602540, 100000000);
  const Rational more = ratio(36602541, 100000000);
  CHECK(time_bounds({1, 0, 0, 0}, {0, 1, 0, 0}, less)[1] < ratio(1, 3));
  CHECK(time_bounds({1, 0, 0, 0}, {0, 1, 0, 0}, more)[0] > ratio(1, 3));
}

TEST_CASE("Bounds of times hold what long doubles compute", "[proofs]") {
  CHECK(rc::check([] {
    Quaternion p;
    Quaternion q;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = *rc::gen::inRange(-9, 10);
      q[k] = *rc::gen::inRange(-9, 10);
    }
    const Rational product = scalar_product(p, q);
    RC_PRE(product >= 0);
    RC_PRE(product * product < scalar_product(p, p) * scalar_product(q, q));
    const Rational s = ratio(*rc::gen::inRange(1, 1000), 1000);
    const auto number = [](const Rational& x) { return static_cast<long double>(nearest_double(x)); };
    // In the plane of the arc, with p along the first axis.
    const long double length = std::sqrt(number(scalar_product(p, p)));
    const long double along = number(product) / length;
    const long double across =
        std::sqrt(number(scalar_product(p, p) * scalar_product(q, q) - product * product)) / length;
    const long double t = number(s);
    const long double truth = std::atan2(t * across, (1 - t) * length + t * along) / std::atan2(across, along);
    const auto [low, high] = time_bounds(p, q, s);
    RC_ASSERT(number(low) <= truth + 1e-15L);
    RC_ASSERT(truth <= number(high) + 1e-15L);
    RC_ASSERT(high - low < Rational(1, Integer(1) << 50));
  }));
}

}  // namespace
}  // namespace nef::planner::test::arc_time
