// SPDX-License-Identifier: Apache-2.0
//
// Signs on segments against plain rational arithmetic, for points that lie on the planes, next to them, and anywhere:
// the filter must never tell a wrong sign.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/planner/partition/exact_point.h"

namespace nef::planner::test {
namespace {

int sign_at(const PlaneTable& planes, PlaneId plane, const Rational3& x) {
  Rational sum(Integer(mpz_class(mpz_srcptr(planes.coefficient(plane, 3)))));
  for (std::size_t i = 0; i < 3; ++i) sum += Integer(mpz_class(mpz_srcptr(planes.coefficient(plane, i)))) * x[i];
  return sgn(sum);
}

// Small numbers, thirds and sevenths, powers of two, with a hair added now and then.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Rational number() {
    static constexpr std::array<int, 6> kDenominators{1, 1, 2, 3, 7, 1024};
    Rational value(integer(-20, 20), kDenominators[static_cast<std::size_t>(integer(0, 5))]);
    value.canonicalize();
    if (integer(0, 3) == 0) value += exact_rational(std::ldexp(integer(-1, 1), integer(-70, -30)));
    return value;
  }
  Rational3 point() { return {number(), number(), number()}; }

 private:
  std::mt19937 random_;
};

TEST_CASE("sides of points and of crossings on segments are exact") {
  Numbers numbers(20261121);
  std::array<int, 3> seen{};
  for (int round = 0; round < 20000; ++round) {
    PlaneTable planes;
    const Rational3 a = numbers.point();
    const Rational3 b = numbers.point();
    if (a == b) continue;
    const ExactPoint pa(a);
    const ExactPoint pb(b);
    const ExactSegment segment(planes, pa, pb);
    // The second plane goes through the point where the segment crosses the first one, or past it by a hair.
    Rational3 normal = numbers.point();
    if (normal == Rational3{}) continue;
    const PlaneId first = planes.intern(normal, numbers.number());
    const int at_a = sign_at(planes, first, a);
    CHECK(pa.side(planes, first.unflipped()) == at_a);
    if (at_a * sign_at(planes, first, b) >= 0) continue;
    const SegmentParameter t = ExactSegment::crossing(segment.forms(first.unflipped()), at_a);
    const Rational3 x = segment.point(segment.exact(t));
    CHECK(sign_at(planes, first, x) == 0);
    normal = numbers.point();
    if (normal == Rational3{}) continue;
    Rational offset = -(normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]);
    const int kind = numbers.integer(0, 3);
    if (kind == 1) offset += exact_rational(std::ldexp(1, -60));
    if (kind == 2) offset -= exact_rational(std::ldexp(1, -45));
    if (kind == 3) offset = numbers.number();
    const PlaneId second = planes.intern(normal, offset).unflipped();
    const int expected = sign_at(planes, second, x);
    CHECK(segment.side(segment.forms(second), t) == expected);
    CHECK(segment.side(segment.forms(second), ExactSegment::fixed(0)) == sign_at(planes, second, a));
    CHECK(segment.side(segment.forms(second), ExactSegment::fixed(1)) == sign_at(planes, second, b));
    ++seen[static_cast<std::size_t>(expected) + 1];
  }
  for (const int count : seen) CHECK(count > 500);
}

}  // namespace
}  // namespace nef::planner::test
