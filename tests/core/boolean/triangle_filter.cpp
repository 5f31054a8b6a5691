// SPDX-License-Identifier: Apache-2.0
//
// Lines through a point of a triangle, which rounding puts on either side of its border, are never said to miss it, at
// any magnitude; lines beside it nearly always are.
#include "nef/boolean/triangle_filter.h"

#include <catch2/catch.hpp>
#include <random>

#include "nef/base/fast_path.h"
#include "tests/support/numbers/magnitudes.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::test {
namespace {

class Lines {
 public:
  explicit Lines(std::uint64_t seed) : random_(seed) {}

  // A rational of about `bits` bits over a small number that is no power of two as a rule.
  Rational number(unsigned bits) {
    return Rational(static_cast<long>(random_() % (1UL << bits)) - (1L << (bits - 1))) /
           static_cast<long>(1 + random_() % 7);
  }
  Rational3 point(unsigned bits) { return {number(bits), number(bits), number(bits)}; }
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

 private:
  std::mt19937_64 random_;
};

Rational3 between(const Rational3& a, const Rational3& b, const Rational& t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

bool says_miss(const std::array<Rational3, 5>& points, const Rational& scale) {
  PointTable table;
  std::array<PointId, 5> id;
  for (std::size_t i = 0; i < 5; ++i) {
    id[i] = table.push({points[i][0] * scale, points[i][1] * scale, points[i][2] * scale});
  }
  return surely_misses_triangle(table, id[0], id[1], {id[2], id[3], id[4]});
}

}  // namespace

TEST_CASE("a line through the border of a triangle is never said to miss it", "[bounds]") {
  Lines lines(1);
  for (unsigned i = 0; i < test::fewer(20000); ++i) {
    const unsigned bits = 4 + static_cast<unsigned>(lines.below(50));
    // Small triangles far from the origin are where coordinates are known worst.
    const Rational3 far = lines.point(bits);
    std::array<Rational3, 3> triangle;
    for (Rational3& corner : triangle)
      corner = between(far, lines.point(bits), Rational(1) / static_cast<long>(1UL << lines.below(40)));
    const Rational t = lines.below(3) == 0 ? Rational(0) : Rational(static_cast<long>(lines.below(1000))) / 1000;
    const Rational3 hit = between(triangle[0], triangle[1], t);
    const Rational3 a = between(hit, lines.point(bits), Rational(1) / static_cast<long>(1UL << lines.below(40)));
    const Rational3 b = between(a, hit, 1 + Rational(static_cast<long>(1 + lines.below(1000))) / 100);
    for (const long power : {0L, -240L, 240L, -420L, 420L, -1100L, 1100L}) {
      REQUIRE_FALSE(says_miss({a, b, triangle[0], triangle[1], triangle[2]}, power_of_two(power)));
    }
  }
}

TEST_CASE("a line beside a triangle is nearly always known to miss it") {
  Lines lines(2);
  int known = 0;
  constexpr int kCases = 2000;
  for (int i = 0; i < kCases; ++i) {
    const std::array<Rational3, 3> triangle{lines.point(30), lines.point(30), lines.point(30)};
    // A point of the plane beyond the edge from corner 1 to corner 2, by a millionth of the triangle at least.
    const Rational out = Rational(static_cast<long>(1 + lines.below(1000000))) / 1000000;
    const Rational3 beside = between(
        triangle[0], between(triangle[1], triangle[2], Rational(static_cast<long>(lines.below(1000))) / 1000), 1 + out);
    const Rational3 a = lines.point(30);
    const Rational3 b = between(a, beside, 2);
    if (says_miss({a, b, triangle[0], triangle[1], triangle[2]}, 1)) ++known;
  }
  CHECK(known >= (kFastPaths ? kCases * 99 / 100 : 0));
}

}  // namespace nef::test
