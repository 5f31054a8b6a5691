// SPDX-License-Identifier: Apache-2.0
//
// Triangulations against what one is: triangles between the polygon's corners, turned like it, whose sides cancel but
// for those of the polygon, and whose areas add up to its own.
#include "nef/mesh/polygon/triangulate.h"

#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <map>

namespace nef::test {
namespace {

using Ring = std::vector<std::uint32_t>;

Rational doubled_area(const std::vector<Rational3>& points, std::span<const std::uint32_t> ring) {
  Rational sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Rational3& p = points[ring[i]];
    const Rational3& q = points[ring[(i + 1) % ring.size()]];
    sum += p[0] * q[1] - q[0] * p[1];
  }
  return sum;
}

void check_triangulation(const std::vector<Rational3>& points, const std::vector<Ring>& rings) {
  const MeshPoints mesh_points{std::span<const Rational3>(points)};
  Triangulator triangulator(mesh_points, {});
  std::vector<Triangulator::Triangle> triangles;
  REQUIRE(triangulator.triangulate(rings, 2, 1, triangles));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  const auto add = [&sides](std::span<const std::uint32_t> ring, int times) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t v = ring[i];
      const std::uint32_t w = ring[(i + 1) % ring.size()];
      sides[{v, w}] += times;
      sides[{w, v}] -= times;
    }
  };
  Rational area;
  for (const auto& triangle : triangles) {
    const Rational its = doubled_area(points, triangle);
    CHECK(its > 0);
    area += its;
    add(triangle, 1);
  }
  Rational whole;
  for (const Ring& ring : rings) {
    whole += doubled_area(points, ring);
    add(ring, -1);
  }
  CHECK(area == whole);
  for (const auto& [side, count] : sides) CHECK(count == 0);
}

// A mountain range over a flat floor: every second corner is blunt, many lie in the boxes of ears, and on their sides.
std::vector<Rational3> mountains(std::size_t teeth, const std::function<Rational(std::size_t)>& height) {
  std::vector<Rational3> points;
  points.push_back({0, -100, 0});
  points.push_back({static_cast<unsigned long>(2 * teeth), -100, 0});
  for (std::size_t i = 2 * teeth + 1; i-- > 0;) {
    points.push_back({static_cast<unsigned long>(i), i % 2 == 0 ? Rational(0) : height(i), 0});
  }
  return points;
}

Ring whole_ring(std::size_t size) {
  Ring ring(size);
  for (std::uint32_t i = 0; i < size; ++i) ring[i] = i;
  return ring;
}

// Turned by the angle of 3-4-5 and moved by thirds: no common small denominator keeps all of it below 2^40.
std::vector<Rational3> awkward(std::vector<Rational3> points) {
  const Rational unit(1, 1000003);
  for (Rational3& p : points) {
    const Rational x = p[0];
    const Rational y = p[1];
    p[0] = (x * Rational(3, 5) - y * Rational(4, 5)) * unit * Rational(1, 998244353) + Rational(1, 3);
    p[1] = (x * Rational(4, 5) + y * Rational(3, 5)) * unit * Rational(1, 998244353) - Rational(1, 7);
    p[2] = 0;
  }
  return points;
}

}  // namespace

TEST_CASE("Triangulations of polygons with many corners that are not convex") {
  for (const bool far : {false, true}) {
    const auto placed = [far](std::vector<Rational3> points) { return far ? awkward(std::move(points)) : points; };
    CHECK(rc::check("mountain ranges of small heights, valleys in one line", [&] {
      const auto teeth = *rc::gen::inRange<std::size_t>(1, 90);
      const auto heights = *rc::gen::container<std::vector<int>>(2 * teeth + 1, rc::gen::inRange(-4, 5));
      const auto points = placed(mountains(teeth, [&](std::size_t i) { return Rational(heights[i]); }));
      check_triangulation(points, {whole_ring(points.size())});
    }));
    // A comb whose slots nearly part it, with square holes in its back.
    std::vector<Rational3> points;
    Ring outer;
    const auto push = [&points](long x, long y, Ring& ring) {
      ring.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({x, y, 0});
    };
    push(0, 0, outer);
    push(400, 0, outer);
    for (long i = 99; i >= 0; --i) {
      push(4 * i + 4, 1000, outer);
      push(4 * i + 2, 1000, outer);
      push(4 * i + 2, 50 + i % 7, outer);
      push(4 * i + 1, 50 + i % 7, outer);
      push(4 * i + 1, 1000, outer);
    }
    push(0, 1000, outer);
    std::vector<Ring> rings{outer};
    for (long i = 0; i < 60; ++i) {
      Ring& hole = rings.emplace_back();
      const long x = 6 * i + 3;
      const long y = 5 + i * 37 % 40;
      push(x, y, hole);
      push(x, y + 2, hole);
      push(x + 3, y + 2, hole);
      push(x + 3, y, hole);
    }
    check_triangulation(placed(points), rings);
  }
}

TEST_CASE("Chosen points of a table answer as the points themselves") {
  CHECK(rc::check([] {
    PointTable table;
    std::vector<Rational3> points;
    std::vector<PointId> chosen;
    const auto count = *rc::gen::inRange(3, 12);
    const bool large = *rc::gen::arbitrary<bool>();
    const bool many = *rc::gen::arbitrary<bool>();  // denominators: their product is not below 2^40
    for (int i = 0; i < count; ++i) {
      std::array<Integer, 7> h;
      for (std::size_t k = 0; k < 3; ++k) h[k] = *rc::gen::inRange(-30, 30);
      h[3] = many ? *rc::gen::element(1, 60, 1000003, 998244353, 999999937) : *rc::gen::element(1, 2, 3, 12, 60);
      const Integer factor = large ? Integer("1000000000000000000000007") : Integer(6);
      Rational3 point;
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = Rational(h[k], h[3]);
        point[k].canonicalize();
      }
      for (std::size_t k = 0; k < 4; ++k) h[k] *= factor;  // not in lowest terms, as intersections come
      const PointId id = table.push_homogeneous(h);
      if (*rc::gen::inRange(0, 4) == 0) continue;
      points.push_back(point);
      chosen.push_back(id);
    }
    const MeshPoints one{std::span<const Rational3>(points)};
    std::vector<std::array<double, 3>> doubles;
    for (const PointId p : chosen) doubles.push_back(table.approximate(p));
    const MeshPoints other(table, chosen, doubles, {});
    RC_ASSERT(other.size() == points.size());
    RC_ASSERT(other.denominator() == one.denominator());
    RC_ASSERT(other.are_integers() == one.are_integers());
    for (std::uint32_t p = 0; other.are_integers() && p < points.size(); ++p) {
      RC_ASSERT(other.integers(p) == one.integers(p));
    }
    for (std::uint32_t a = 0; a < points.size(); ++a) {
      for (std::uint32_t b = 0; b < points.size(); ++b) {
        RC_ASSERT(other.compare(a, b) == (points[a] > points[b]) - (points[a] < points[b]));
        const std::uint32_t c = (2 * b + 1) % static_cast<std::uint32_t>(points.size());
        const std::uint32_t d = (a + b + 2) % static_cast<std::uint32_t>(points.size());
        Rational determinant;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3;
          const std::size_t k = (i + 2) % 3;
          const Rational minor = (points[b][j] - points[a][j]) * (points[c][k] - points[a][k]) -
                                 (points[c][j] - points[a][j]) * (points[b][k] - points[a][k]);
          RC_ASSERT(other.orientation_along(a, b, c, i, {}) == sgn(minor));
          determinant += minor * (points[d][i] - points[a][i]);
        }
        RC_ASSERT(other.orientation(a, b, c, d, {}) == sgn(determinant));
      }
    }
  }));
}

TEST_CASE("Points that may not be asked about do not matter") {
  CHECK(rc::check([] {
    PointTable table;
    std::vector<PointId> places;
    std::vector<std::array<double, 3>> doubles;
    std::vector<std::uint32_t> asked;
    std::vector<Rational3> of_asked;
    const Integer wide("1000000000000000000000007");
    for (int i = *rc::gen::inRange(4, 12); i > 0; --i) {
      const bool odd = *rc::gen::arbitrary<bool>();  // a denominator that no small integers allow for
      std::array<Integer, 7> h;
      for (std::size_t k = 0; k < 3; ++k) h[k] = *rc::gen::inRange(-5, 5);
      h[3] = odd ? wide : Integer(*rc::gen::element(1, 2, 5));
      Rational3 point;
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = Rational(h[k], h[3]);
        point[k].canonicalize();
      }
      if (!odd) {
        asked.push_back(static_cast<std::uint32_t>(places.size()));
        of_asked.push_back(point);
      }
      places.push_back(table.push_homogeneous(h));
      doubles.push_back(table.approximate(places.back()));
    }
    RC_PRE(!asked.empty());
    const MeshPoints borrowed(table, places, doubles, asked);
    const MeshPoints own{std::span<const Rational3>(of_asked)};
    RC_ASSERT(borrowed.are_integers());
    RC_ASSERT(borrowed.denominator() == own.denominator());
    const auto count = static_cast<std::uint32_t>(asked.size());
    for (std::uint32_t a = 0; a < count; ++a) {
      RC_ASSERT(borrowed.integers(asked[a]) == own.integers(a));
      for (std::uint32_t b = 0; b < count; ++b) {
        const std::uint32_t c = (a + 2 * b + 1) % count;
        RC_ASSERT(borrowed.compare(asked[a], asked[b]) == (of_asked[a] > of_asked[b]) - (of_asked[a] < of_asked[b]));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          RC_ASSERT(borrowed.orientation_along(asked[a], asked[b], asked[c], axis, {}) ==
                    own.orientation_along(a, b, c, axis, {}));
        }
      }
    }
  }));
}

}  // namespace nef::test
