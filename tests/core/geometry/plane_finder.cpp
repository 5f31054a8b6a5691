// SPDX-License-Identifier: Apache-2.0
//
// Planes through three points are those of their exact normals, however long the numbers are.
#include <rapidcheck.h>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
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

Integer integer_of_bits(int bits) {
  constexpr int kWord = 62;
  Integer result = 0;
  for (; bits > 0; bits -= kWord) {
    const std::int64_t limit = std::int64_t{1} << std::min(bits, kWord);
    result = result * Integer(limit) + Integer(*rc::gen::inRange<std::int64_t>(-limit + 1, limit));
  }
  return result;
}

// Integers of so many bits, over powers of ten or two, as files have them: a common denominator of 1 to 2^90.
Rational3 random_point(int bits, int base, int places) {
  Rational3 result;
  for (Rational& x : result) {
    x = Rational(integer_of_bits(bits));
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
    const int bits = *rc::gen::element(2, 8, 24, 31, 32, 40, 53, 61, 62, 64, 80, 125, 126, 130);
    const int places = *rc::gen::element(0, 1, 7, 12, 18, 19, 30, 53, 64, 90);
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
    // Over any common denominator, not only the least one.
    Integer common = *rc::gen::element(1, 2, 12);
    for (const Rational3& point : triangle) {
      for (const Rational& x : point) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), x.get_den_mpz_t());
    }
    std::array<std::array<std::int64_t, 3>, 3> corners{};
    bool are_small = mpz_sizeinbase(common.get_mpz_t(), 2) <= 62;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational scaled = triangle[k][i] * common;
        are_small = are_small && mpz_sizeinbase(scaled.get_num_mpz_t(), 2) <= 62;
        if (are_small) corners[k][i] = scaled.get_num().get_si();
      }
    }
    if (!are_small) return;
    const std::optional<PlaneId> short_one = PlaneFinder::through(planes, corners, common.get_si());
    RC_ASSERT(!short_one || *short_one == found);
  }));
}

TEST_CASE("planes at the limits of machine integers") {
  // Widths of differences that add up to 62 and 63 bits, numbers of 61 and 62 and of 125 to 127, denominators of 61, 62
  // and 64.
  const auto n = [](int bits) { return Rational(power_of(2, bits) - 1); };
  for (const int bits : {30, 31, 32, 60, 61, 62, 63, 64, 94, 95, 125, 126, 127}) {
    for (const int below : {0, 1, 30, 61, 62, 63, 64}) {
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

TEST_CASE("planes of sides of up to 64 bits") {
  // The parts of the normal are differences of products of 126 bits, and longer.
  const auto n = [](int bits) { return Rational(power_of(2, bits) - 1); };
  for (const int first : {61, 62, 63, 64}) {
    for (const int second : {61, 62, 63, 64}) {
      for (const Rational& scale : {Rational(1), power_of(10, -19), power_of(2, -64)}) {
        std::array<Rational3, 3> triangle{Rational3{5, -7, 11}, Rational3{5 + n(first), -7 - n(first), 11 + n(first)},
                                          Rational3{5 + n(second), -7 + n(second), 11 - n(second)}};
        for (Rational3& point : triangle) {
          for (Rational& x : point) x *= scale;
        }
        PointTable points;
        std::array<PointId, 3> ids;
        for (std::size_t k = 0; k < 3; ++k) ids[k] = points.push(triangle[k]);
        PlaneTable planes;
        CHECK(PlaneFinder().through(planes, points, ids[0], ids[1], ids[2]) == expected(planes, triangle));
      }
    }
  }
}

TEST_CASE("points have the least common denominator of their coordinates, of one word or more") {
  CHECK(rc::check("fractions", [] {
    const int base = *rc::gen::element(2, 10);
    const Rational3 point =
        random_point(*rc::gen::element(1, 31, 62, 63, 64, 65, 130), base, *rc::gen::element(0, 18, 19, 20, 63, 64, 65));
    PointTable points;
    const PointId id = points.push(point);
    RC_ASSERT(points.rational(id) == point);
    Integer common = 1;
    for (const Rational& x : point) common = lcm(common, x.get_den());
    RC_ASSERT(mpz_cmp(points.coordinate(id, 3), common.get_mpz_t()) == 0);
    for (std::size_t i = 0; i < 3; ++i) {
      // Two units, and what quotients of small numbers lose (PointTable).
      RC_ASSERT(abs(Rational(points.approximate(id)[i]) - point[i]) <= abs(point[i]) * Rational(0x1p-51));
    }
  }));
}

TEST_CASE("doubles of planes are the coefficients, cut off after 53 bits") {
  CHECK(rc::check("coefficients of any length", [] {
    std::array<Integer, 4> row;
    for (Integer& x : row)
      x = integer_of_bits(*rc::gen::element(0, 1, 11, 53, 54, 63, 64, 65, 120, 128, 129, 1000, 1100));
    if (row[0] == 0 && row[1] == 0 && row[2] == 0) return;
    PlaneTable planes;
    const PlaneId plane = planes.intern(row[0], row[1], row[2], row[3], 0);
    long top = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (planes.coefficient(plane, i).sign() != 0)
        top = std::max(top, static_cast<long>(mpz_sizeinbase(planes.coefficient(plane, i), 2)));
    }
    std::array<double, 4> wanted{};
    bool lost = false;
    for (std::size_t i = 0; i < 4; ++i) {
      long exponent = 0;
      const double mantissa = mpz_get_d_2exp(&exponent, planes.coefficient(plane, i));
      const long shift = exponent - top;
      wanted[i] = shift > 1023    ? std::copysign(HUGE_VAL, mantissa)
                  : shift < -1060 ? 0
                                  : std::ldexp(mantissa, static_cast<int>(shift));
      lost = lost || (i < 3 && mantissa != 0 && std::fabs(wanted[i]) < 0x1p-1000);
    }
    if (lost) wanted[3] = HUGE_VAL;
    RC_ASSERT(planes.approximate(plane) == wanted);
  }));
}

}  // namespace nef
