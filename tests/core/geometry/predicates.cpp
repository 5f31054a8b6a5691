// SPDX-License-Identifier: Apache-2.0
//
// Predicates at and near their zeros: the answer is exact, and the counters tell which stage gave it.
#include "nef/geometry/predicates.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/geometry/ray_filter.h"

namespace nef::test {
namespace {

Integer power(unsigned long base, unsigned long exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

}  // namespace

TEST_CASE("coplanar means the same row, whatever the scale and the side") {
  PlaneTable planes;
  const PlaneId a = planes.intern(2, 4, -6, 8);
  CHECK(planes.intern(1, 2, -3, 4) == a);
  CHECK(planes.intern(-3, -6, 9, -12) == a.opposite());
  CHECK(planes.intern(Rational3{Rational(1, 6), Rational(1, 3), Rational(-1, 2)}, Rational(2, 3)) == a);
  CHECK(planes.size() == 1);
  CHECK(planes.intern(1, 2, -3, 5).row() != a.row());
}

TEST_CASE("a plane is found again however it came into the table") {
  PlaneTable planes;
  const PlaneId a = planes.intern(0, -3, 5, 7);
  const auto primitive = [&planes](const std::array<Integer, 4>& n) {
    return planes.intern_primitive({n[0].get_mpz_t(), n[1].get_mpz_t(), n[2].get_mpz_t(), n[3].get_mpz_t()});
  };
  CHECK(primitive({0, -3, 5, 7}) == a);
  CHECK(primitive({0, 3, -5, -7}) == a.opposite());
  CHECK(primitive({0, 0, -1, 0}) == planes.intern(0, 0, -4, 0));
  PlaneTable others;
  for (int i = 1; i < 100; ++i) others.intern(i, 1, 2, 3);
  PlaneTable copies;
  for (std::uint32_t row = 0; row < others.size(); row += 2) CHECK(copies.append_new(others, row) == row / 2);
  for (int i = 1; i < 100; ++i) {
    const PlaneId other = others.intern(i, 1, 2, 3);
    const PlaneId copy = copies.intern_from(others, other.opposite());
    CHECK(copy == copies.intern(-i, -1, -2, -3));
    CHECK(copies.oriented_coefficient(copy, 0) == -i);
    CHECK(copies.approximate(copy) == others.approximate(other));
  }
  CHECK(copies.size() == others.size());
}

TEST_CASE("side of plane: far by the filter, on it exactly, beside it exactly", "[fast]") {
  PlaneTable planes;
  PointTable points;
  const PlaneId plane = planes.intern(1, 1, 1, -1);
  const PointId on = points.push({Rational(1, 3), Rational(1, 3), Rational(1, 3)});
  const Rational tiny(Integer(1), power(10, 40));
  const PointId above = points.push({Rational(1, 3), Rational(1, 3), Rational(1, 3) + tiny});
  const PointId below = points.push({Rational(1, 3), Rational(1, 3), Rational(1, 3) - tiny});
  const PointId far = points.push({5, 6, 7});
  PredicateCounts counts;
  const Monitor monitor = Monitor().counting(counts);
  CHECK(side_of_plane(planes, plane, points, far, monitor) == 1);
  CHECK(counts.filter == 1);
  CHECK(counts.exact == 0);
  CHECK(side_of_plane(planes, plane, points, on, monitor) == 0);
  CHECK(side_of_plane(planes, plane, points, above, monitor) == 1);
  CHECK(side_of_plane(planes, plane, points, below, monitor) == -1);
  CHECK(side_of_plane(planes, plane.opposite(), points, above, monitor) == -1);
  CHECK(counts.filter == 1);
  CHECK(counts.exact == 4);
}

TEST_CASE(
    "what no double has beside the largest component of a plane or a direction counts where points are far away") {
  PlaneTable planes;
  PointTable points;
  const Integer far = power(2, 680);
  const PlaneId plane = planes.intern(far, power(2, 1080), 1, 0);
  CHECK(side_of_plane(planes, plane, points, points.push({1, 0, Rational(-far)}), {}) == 0);
  CHECK(side_of_plane(planes, plane, points, points.push({1, 0, Rational(-far - 1)}), {}) == -1);
  CHECK(side_of_plane(planes, plane.opposite(), points, points.push({1, 0, Rational(-far - 1)}), {}) == 1);

  Box origin;
  origin.add_rounded({0, 0, 0});
  const auto may_meet = [&origin](const Direction& direction, const std::array<double, 3>& point) {
    Box there;
    there.add_rounded(point);
    return RayFilter(origin, direction).may_meet(there);
  };
  CHECK(may_meet(Direction::exact(1, power(2, 1080), power(2, 700)), {0x1p-100, 0x1p980, 0x1p600}));
  // A component that is all but lost in a product of doubles: the direction is (1, n^2, -(n^2 + n)).
  const Integer n = power(2, 60);
  const Direction along = Direction::cross(planes, planes.intern(0, n + 1, n, 0), planes.intern(n, n + 2, n + 1, 0));
  CHECK(along.integers() == Integer3{1, n * n, -(n * n + n)});
  CHECK(may_meet(along, {1, 0x1p120, -(0x1p120 + 0x1p60)}));
  CHECK_FALSE(may_meet(along, {-1, 0x1p120, -(0x1p120 + 0x1p60)}));
}

TEST_CASE("coordinates beyond the range of doubles are compared exactly") {
  PlaneTable planes;
  PointTable points;
  const Integer huge = power(10, 400);
  const PointId a = points.push({Rational(huge), 0, 0});
  const PointId b = points.push({Rational(huge) + 1, 0, 0});
  const PointId c = points.push({Rational(Integer(1), huge), 0, 0});
  const PointId zero = points.push({0, 0, 0});
  CHECK(compare_coordinate(points, a, b, 0, {}) == -1);
  CHECK(compare_coordinate(points, b, a, 0, {}) == 1);
  CHECK(compare_coordinate(points, c, zero, 0, {}) == 1);
  CHECK(compare_lexicographic(points, a, a, {}) == 0);
  CHECK(compare_lexicographic(points, zero, c, {}) == -1);
  const PlaneId plane = planes.intern(1, 0, 0, Integer(-huge));
  CHECK(side_of_plane(planes, plane, points, a, {}) == 0);
  CHECK(side_of_plane(planes, plane, points, b, {}) == 1);
  CHECK(side_of_plane(planes, plane, points, c, {}) == -1);
}

TEST_CASE("three planes meet in a point that lies on them") {
  PlaneTable planes;
  PointTable points;
  const PlaneId p = planes.intern(3, 5, 7, 11);
  const PlaneId q = planes.intern(2, -1, 4, 13);
  const PlaneId r = planes.intern(1, 1, -9, 17);
  const std::optional<PointId> point = points.push_intersection(planes, p, q.opposite(), r);
  REQUIRE(point);
  for (const PlaneId plane : {p, q, r}) CHECK(side_of_plane(planes, plane, points, *point, {}) == 0);
  const PlaneId parallel = planes.intern(3, 5, 7, 12);
  CHECK_FALSE(points.push_intersection(planes, p, parallel, r));
  const PlaneId through_line = planes.intern(5, 4, 11, 24);  // p + q
  CHECK_FALSE(points.push_intersection(planes, p, q, through_line));
}

TEST_CASE("points of planes and of fractions are the same however wide their integers are") {
  std::mt19937_64 random(7);
  // Coefficients of up to 12, 40 and 41 bits: machine integers, the widest of these, and beyond.
  for (const unsigned bits : {12U, 40U, 41U, 70U}) {
    const auto number = [&] {
      Integer value = Integer(static_cast<unsigned long>(random() >> 1U)) << (bits > 60 ? bits - 60 : 0);
      value %= power(2, bits);
      if (random() % 4 == 0) value = power(2, bits) - 1;
      return random() % 2 == 0 ? value : Integer(-value);
    };
    for (int round = 0; round < 100; ++round) {
      INFO(bits << " bits, round " << round);
      PlaneTable planes;
      PointTable points;
      std::array<std::array<Integer, 4>, 3> n;
      std::array<PlaneId, 3> plane;
      for (std::size_t i = 0; i < 3; ++i) {
        for (Integer& value : n[i]) value = number();
        plane[i] = planes.intern(n[i][0], n[i][1], n[i][2], n[i][3]);
      }
      const auto det = [&](std::size_t a, std::size_t b, std::size_t c) {
        return Integer(n[0][a] * (n[1][b] * n[2][c] - n[1][c] * n[2][b]) -
                       n[0][b] * (n[1][a] * n[2][c] - n[1][c] * n[2][a]) +
                       n[0][c] * (n[1][a] * n[2][b] - n[1][b] * n[2][a]));
      };
      const Integer w = det(0, 1, 2);
      const std::optional<PointId> point = points.push_intersection(planes, plane[0], plane[1], plane[2]);
      REQUIRE(point.has_value() == (w != 0));
      if (!point) continue;
      // Cramer's rule: the column of a coordinate is replaced by the negated offsets.
      const Rational3 expected{Rational(Integer(-det(3, 1, 2)), w), Rational(Integer(-det(0, 3, 2)), w),
                               Rational(Integer(-det(0, 1, 3)), w)};
      Rational3 reduced = expected;
      for (Rational& x : reduced) x.canonicalize();
      CHECK(points.rational(*point) == reduced);
      CHECK(sgn(Integer(points.coordinate(*point, 3))) > 0);
      const PointId again = points.push(reduced);
      CHECK(compare_lexicographic(points, *point, again, {}) == 0);
      for (std::size_t i = 0; i < 3; ++i) {
        const double truth = nearest_double(reduced[i]);
        CHECK(std::abs(points.approximate(*point)[i] - truth) <= std::abs(truth) * 0x1p-50);
        CHECK(std::abs(points.approximate(again)[i] - truth) <= std::abs(truth) * 0x1p-50);
      }
    }
  }
}

TEST_CASE("signs of sums that all but vanish are exact, however wide the integers are") {
  std::mt19937_64 random(11);
  for (const unsigned bits : {20U, 30U, 31U, 61U, 62U, 63U, 64U, 90U}) {
    // As wide as that, and often as large as that can be.
    const auto number = [&]() -> Integer {
      Integer value = power(2, bits) - 1 - static_cast<long>(random() % 3);
      if (random() % 2 == 0) value = Integer(static_cast<unsigned long>(random())) * power(2, bits) / power(2, 64);
      return random() % 2 == 0 ? value : Integer(-value);
    };
    for (int round = 0; round < 100; ++round) {
      INFO(bits << " bits, round " << round);
      PlaneTable planes;
      PointTable points;
      const Integer3 n{number(), number(), number() | 1};
      const Integer w = abs(number()) | 1;
      const std::array<Integer, 3> x{number(), number(), number()};
      const auto fraction = [](const Integer& numerator, const Integer& denominator) -> Rational {
        Rational result(numerator, denominator);
        result.canonicalize();
        return result;
      };
      // The last coordinate is that of the plane there, or beside it.
      const Integer d = number();
      const Rational on = fraction(-(n[0] * x[0] + n[1] * x[1] + d * w), n[2] * w);
      const Rational beside = fraction(static_cast<long>(random() % 3) - 1, power(2, 2 * bits));
      const PlaneId plane = planes.intern(n[0], n[1], n[2], d);
      const Rational3 at{fraction(x[0], w), fraction(x[1], w), on + beside};
      const Rational sum = n[0] * at[0] + n[1] * at[1] + n[2] * at[2] + d;
      CHECK(side_of_plane(planes, plane, points, points.push(at), {}) == sgn(sum));
      // Of one denominator and of two: that of a plane x = constant, and the order of neighbours.
      const std::array<Rational, 2> values{
          fraction(x[0], w), random() % 2 == 0 ? fraction(x[0] * 2, w * 2) : fraction(x[0] * 2 + 1, w * 2)};
      const PointId a = points.push({values[0], 0, 0});
      const PointId b = points.push({values[1], 0, 0});
      CHECK(compare_coordinate(points, a, b, 0, {}) == sgn(Rational(values[0] - values[1])));
      const PlaneId wall = planes.intern(values[0].get_den(), 0, 0, Integer(-values[0].get_num()));
      CHECK(side_of_plane(planes, wall, points, a, {}) == 0);
      CHECK(side_of_plane(planes, wall, points, b, {}) ==
            (wall.flipped() ? -1 : 1) * sgn(Rational(values[1] - values[0])));
    }
  }
}

TEST_CASE("infimaximal points and planes: R is greater than every number") {
  PlaneTable planes;
  PointTable points;
  const PlaneId wall = planes.intern(1, 0, 0, 0, -1);  // x = R
  const PlaneId y = planes.intern(0, 1, 0, -5);
  const PlaneId z = planes.intern(0, 0, 1, 0);
  const std::optional<PointId> at_wall = points.push_intersection(planes, wall, y, z);
  REQUIRE(at_wall);
  CHECK_FALSE(points.finite(*at_wall));
  CHECK(side_of_plane(planes, wall, points, *at_wall, {}) == 0);
  CHECK(side_of_plane(planes, y, points, *at_wall, {}) == 0);
  const PointId far = points.push({Rational(power(10, 100)), 5, 0});
  CHECK(side_of_plane(planes, wall, points, far, {}) == -1);
  CHECK(compare_coordinate(points, *at_wall, far, 0, {}) == 1);
  CHECK(compare_coordinate(points, *at_wall, far, 1, {}) == 0);
  const PlaneId x = planes.intern(1, 0, 0, Integer(-power(10, 100)));
  CHECK(side_of_plane(planes, x, points, *at_wall, {}) == 1);
}

TEST_CASE("directions: equality by identity, by filter, exactly", "[fast]") {
  PlaneTable planes;
  const PlaneId p = planes.intern(1, 2, 3, 0);
  const PlaneId q = planes.intern(3, -1, 2, 0);
  const PlaneId r = planes.intern(4, 1, 5, 0);  // p + q: through the same line
  const Direction d = Direction::cross(planes, p, q);
  PredicateCounts counts;
  const Monitor monitor = Monitor().counting(counts);
  CHECK(same_direction(d, Direction::cross(planes, p, q), monitor));
  CHECK(counts.identity == 1);
  CHECK(same_direction(d, Direction::cross(planes, p, r), monitor));
  CHECK(counts.exact > 0);
  CHECK_FALSE(same_direction(d, Direction::cross(planes, r, p), monitor));
  CHECK(same_direction(d.negated(), Direction::cross(planes, q, p), monitor));
  CHECK(same_direction(d.negated(), Direction::cross(planes, p.opposite(), q), monitor));
  const PredicateCounts before = counts;
  CHECK_FALSE(same_direction(d, Direction::exact(1, 0, 0), monitor));
  CHECK(counts.filter == before.filter + 1);
  CHECK(side_of_circle(planes, p, d, monitor) == 0);
  CHECK(side_of_circle(planes, r, d, monitor) == 0);
}

TEST_CASE("directions of nearly parallel planes are told apart") {
  PlaneTable planes;
  const Integer big = power(10, 40);
  const PlaneId p = planes.intern(big, 0, 1, 0);
  const PlaneId q = planes.intern(big, 1, 0, 0);
  const PlaneId s = planes.intern(Integer(big + 1), 1, 0, 0);
  const Direction pq = Direction::cross(planes, p, q);
  const Direction ps = Direction::cross(planes, p, s);
  CHECK_FALSE(pq.is_zero());
  CHECK_FALSE(same_direction(pq, ps, {}));
  CHECK(sign_of_dot(Direction::normal(planes, p), pq, {}) == 0);
  CHECK(sign_of_dot(Direction::normal(planes, s), pq, {}) != 0);
  CHECK(sign_of_determinant(Direction::normal(planes, p), Direction::normal(planes, q), pq, {}) > 0);
}

// The filters against the integers, on small vectors where zeros are common.
TEST_CASE("signs of determinants agree with integer arithmetic") {
  std::uint64_t state = 12345;
  const auto next = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<long>(state >> 33U) % 5 - 2;
  };
  for (int i = 0; i < 3000; ++i) {
    long v[3][3];
    for (auto& row : v) {
      do {
        for (long& x : row) x = next();
      } while (row[0] == 0 && row[1] == 0 && row[2] == 0);
    }
    const Direction a = Direction::exact(v[0][0], v[0][1], v[0][2]);
    const Direction b = Direction::exact(v[1][0], v[1][1], v[1][2]);
    const Direction c = Direction::exact(v[2][0], v[2][1], v[2][2]);
    const long det = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                     v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                     v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    const long dot = v[0][0] * v[1][0] + v[0][1] * v[1][1] + v[0][2] * v[1][2];
    REQUIRE(sign_of_determinant(a, b, c, {}) == (det > 0) - (det < 0));
    REQUIRE(sign_of_dot(a, b, {}) == (dot > 0) - (dot < 0));
    const bool parallel = v[0][1] * v[1][2] == v[0][2] * v[1][1] && v[0][2] * v[1][0] == v[0][0] * v[1][2] &&
                          v[0][0] * v[1][1] == v[0][1] * v[1][0];
    REQUIRE(same_direction(a, b, {}) == (parallel && dot > 0));
  }
}

}  // namespace nef::test
