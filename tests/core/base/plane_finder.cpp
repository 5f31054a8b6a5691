// SPDX-License-Identifier: Apache-2.0
//
// Planes through three points are those of their exact normals, however long the numbers are.
#include <rapidcheck.h>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "nef/geometry/plane_finder.h"
#include "nef/geometry/vectors.h"

namespace nef {
namespace {

Rational power_of(int base, int exponent) {
  Rational result = 1;
  for (int i = 0; i < std::abs(exponent); ++i) result *= base;
  return exponent < 0 ? Rational(1 / result) : result;
}

// Integers of so many bits, over powers of ten or two, as files have them: a common denominator of 1 to 2^90.
Rational3 random_point(int bits, int base, int places) {
  Rational3 result;
  for (Rational& x : result) {
    const std::int64_t limit = std::int64_t{1} << bits;
    x = Rational(Integer(*rc::gen::inRange<std::int64_t>(-limit + 1, limit)));
    x *= power_of(base, -*rc::gen::inRange(0, places + 1));
  }
  return result;
}

// The same by rationals.
PlaneId expected(PlaneTable& planes, const std::array<Rational3, 3>& t) {
  const Rational3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  return is_zero(normal) ? PlaneId() : plane_through(planes, normal, t[0]);
}

}  // namespace

TEST_CASE("planes of triangles are those of their exact normals") {
  CHECK(rc::check("short and long numbers", [] {
    const int base = *rc::gen::element(2, 10);
    const int bits = *rc::gen::element(2, 8, 24, 31, 32, 40, 53, 61, 62);
    const int places = *rc::gen::element(0, 1, 7, 12, 18, 30, 53, 90);
    std::array<Rational3, 3> triangle;
    for (Rational3& point : triangle) point = random_point(bits, base, places);
    // Next to each other, as the corners of a face are; and on one line.
    const int shrink = *rc::gen::element(0, 0, 6, 20);
    for (std::size_t k = 1; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[k][i] = triangle[0][i] + (triangle[k][i] - triangle[0][i]) * power_of(2, -shrink);
      }
    }
    if (*rc::gen::inRange(0, 10) == 0) {
      for (std::size_t i = 0; i < 3; ++i) triangle[2][i] = 3 * triangle[1][i] - 2 * triangle[0][i];
    }
    PointTable points;
    std::array<PointId, 3> ids;
    for (std::size_t k = 0; k < 3; ++k) ids[k] = points.push(triangle[k]);
    PlaneTable planes;
    PlaneFinder finder;
    const PlaneId found = finder.through(planes, points, ids[0], ids[1], ids[2]);
    RC_ASSERT(found == expected(planes, triangle));
    RC_ASSERT(finder.through(planes, points, ids[0], ids[2], ids[1]) == (found.valid() ? found.opposite() : found));
  }));
}

TEST_CASE("planes at the limits of machine integers") {
  // Widths of differences that add up to 62 and 63 bits, numbers of 61 and 62, denominators of 61 and 62.
  const auto n = [](int bits) { return Rational(power_of(2, bits) - 1); };
  for (const int bits : {30, 31, 32, 60, 61, 62}) {
    for (const int below : {0, 1, 30, 61, 62}) {
      const std::array<Rational3, 3> triangle{
          Rational3{n(bits), -n(bits), n(bits)},
          Rational3{n(bits) - n(31), -n(bits) + n(30), n(bits) - 1 / power_of(2, below)},
          Rational3{n(bits) - n(30), -n(bits), n(bits) - n(31)}};
      PointTable points;
      std::array<PointId, 3> ids;
      for (std::size_t k = 0; k < 3; ++k) ids[k] = points.push(triangle[k]);
      PlaneTable planes;
      CHECK(PlaneFinder().through(planes, points, ids[0], ids[1], ids[2]) == expected(planes, triangle));
    }
  }
}

}  // namespace nef
