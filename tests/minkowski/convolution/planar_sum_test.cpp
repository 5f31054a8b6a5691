// SPDX-License-Identifier: Apache-2.0
//
// Sums of flat sets by planar convolution against those by cells, as sets; squares of the grid against the sum.
#include "apps/minkowski/planar/planar_sum.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/planar/covered_cells.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/machine_parts.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::MinkowskiReport;
using nef::minkowski::PlanarFrame;
using nef::minkowski::PlanarPolygon;
using nef::minkowski::UnionStrategy;
using nef::test::check;
using nef::test::recipes;
using nef::test::set;
using nef::test::valid;

struct Sums {
  Polyhedron planar, by_cells;
  bool is_planar = false;  // what the report says of the first
};

Sums sums_of(const Polyhedron& a, const Polyhedron& b) {
  Sums result;
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kConvolution;
  MinkowskiReport report;
  result.planar = valid(minkowski_sum(a, b, options, &report), "sum");
  result.is_planar = report.choices.back().why == "both operands are closed polygons in parallel planes";
  options.strategy = UnionStrategy::kQueue;
  result.by_cells = minkowski_sum(a, b, options);
  return result;
}

void check_planar(const Polyhedron& a, const Polyhedron& b) {
  const Sums sums = sums_of(a, b);
  CHECK(sums.is_planar);
  CHECK(nef::equal(sums.planar, sums.by_cells));
}

Polyhedron polygon(const std::vector<std::array<double, 2>>& outline) {
  std::vector<Rational3> ring;
  for (const auto& [x, y] : outline) ring.push_back({nef::exact_rational(x), nef::exact_rational(y), Rational(1)});
  return nef::make_polygon(std::vector<std::vector<Rational3>>{ring});
}

PlanarPolygon planar(const std::vector<std::array<double, 2>>& outline) {
  PlanarPolygon result;
  for (const auto& [x, y] : outline)
    result.corners.push_back({nef::exact_rational(x), nef::exact_rational(y), Rational(1)});
  result.ring_end.push_back(static_cast<std::uint32_t>(result.corners.size()));
  return result;
}

// What a plane cuts out of a solid: with holes, several parts, and corners at which parts touch.
Polyhedron slice(const Polyhedron& solid, int height) {
  const Rational z(2 * height + 1, 2);
  const std::vector<Rational3> square = {{-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}};
  return nef::intersect(solid, nef::make_polygon(std::vector<std::vector<Rational3>>{square}));
}

TEST_CASE("planar sums: slices of solids on a grid, in planes of every direction") {
  int planar_ones = 0;
  check("slices", 200, [&planar_ones] {
    Polyhedron a = slice(nef::regularize((*recipes(true, 6)).make()), *rc::gen::inRange(0, 3));
    Polyhedron b = slice(nef::regularize((*recipes(true, 4, 2)).make()), *rc::gen::inRange(0, 2));
    RC_PRE(!a.is_empty() && !b.is_empty());
    const int m[3][3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
    nef::AffineMap map = nef::AffineMap::identity();
    const int direction = *rc::gen::inRange(0, 4);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j)
        map.linear[i][j] = direction == 3 ? Rational(m[i][j], 3) : Rational((j + direction) % 3 == i ? 1 : 0);
    }
    const Sums sums = sums_of(nef::transform(a, map), nef::transform(b, map));
    RC_ASSERT(nef::equal(sums.planar, sums.by_cells));
    planar_ones += sums.is_planar ? 1 : 0;
  });
  CHECK(planar_ones > 0);
}

TEST_CASE("planar sums: holes that the other set fills, fits into, or leaves a part of") {
  const std::string frame = "closure(polygon(0,0,0, 9,0,0, 9,9,0, 0,9,0) - polygon(2,2,0, 6,2,0, 6,5,0, 2,5,0))";
  for (const std::string other : {"polygon(0,0,0, 1,0,0, 1,1,0, 0,1,0)", "polygon(0,0,0, 4,0,0, 4,3,0, 0,3,0)",
                                  "polygon(0,0,0, 4,0,0, 4,1,0, 0,1,0)", "polygon(0,0,0, 5,0,0, 5,4,0, 0,4,0)",
                                  "polygon(0,0,0, 3,0,0, 1,1,0, 0,4,0)"}) {
    INFO(other);
    check_planar(set(frame), set(other));
    check_planar(set(other), set(frame));
  }
  check_planar(set(frame), set(frame));
  check_planar(set(frame), set("polygon(0,0,5, 1,0,5, 0,1,5) + polygon(9,9,7, 9,8,7, 8,9,7)"));
}

TEST_CASE("planar sums: a hole that touches the outer ring, and parts that touch at a corner") {
  const std::string pinched = "closure(polygon(0,0,0, 4,0,0, 4,4,0, 0,4,0) - polygon(0,0,0, 2,1,0, 1,2,0))";
  const std::string bow = "polygon(0,0,0, 1,0,0, 0,1,0) + polygon(0,0,0, -1,0,0, 0,-1,0)";
  for (const std::string& other : {pinched, bow, std::string("polygon(0,0,0, 1/9,0,0, 0,1/9,0)")}) {
    check_planar(set(pinched), set(other));
    check_planar(set(bow), set(other));
  }
}

TEST_CASE("planar sums: gears in doubles, of which most segments are dropped by the grid") {
  const auto gear = nef::test::gear_outline(9, 10, 2);
  auto turned = nef::test::gear_outline(7, 4, 1.5);
  for (auto& [x, y] : turned) x += 0.125 * y;
  check_planar(polygon(gear), polygon(gear));
  check_planar(polygon(gear), polygon(turned));
}

TEST_CASE("planar sums: sets that are not closed, not flat or not parallel are no planar sums") {
  const Polyhedron square = set("polygon(0,0,0, 1,0,0, 1,1,0, 0,1,0)");
  for (const std::string other :
       {"polygon(0,0,0, 1,0,0, 1,1,0) - point(0,0,0)", "polygon(0,0,0, 1,0,0, 1,1,1)",
        "polygon(0,0,0, 1,0,0, 1,1,0) + segment(2,2,0, 3,3,0)", "polygon(0,0,0, 1,0,0, 1,1,0) + box(2,2,2, 3,3,3)"}) {
    INFO(other);
    const Sums sums = sums_of(square, set(other));
    CHECK_FALSE(sums.is_planar);
    CHECK(nef::equal(sums.planar, sums.by_cells));
  }
}

TEST_CASE("planar sums: squares of the grid that are covered lie in the inside of the sum") {
  const auto gear = nef::test::gear_outline(6, 3, 1);
  const auto other = nef::test::gear_outline(3, 1, 1);
  const nef::minkowski::CoveredCells covered(planar(gear), planar(other), PlanarFrame{2, 1}, 32);
  // Inside of the sum of the open polygons: a disc around the point is in the closed sum.
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kQueue;
  const Polyhedron sum = minkowski_sum(polygon(gear), polygon(other), options);
  const Polyhedron border = nef::subtract(
      sum,
      nef::subtract(sum, nef::closure(nef::subtract(set("polygon(-20,-20,2, 20,-20,2, 20,20,2, -20,20,2)"), sum))));
  int found = 0;
  constexpr int kSteps = 60;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int k = -kSteps; k <= kSteps; ++k) {
      const std::array<double, 2> from = {i * 0.1 + 0.01, k * 0.1 - 0.02};
      const std::array<double, 2> to = {from[0] + 0.05, from[1] + 0.03};
      if (!covered.cover(from, to)) continue;
      ++found;
      for (const auto& p : {from, to}) {
        const Rational3 x = {nef::exact_rational(p[0]), nef::exact_rational(p[1]), Rational(2)};
        REQUIRE(nef::contains(sum, x));
        REQUIRE_FALSE(nef::contains(border, x));
      }
    }
  }
  CHECK(found > 2000);
}

}  // namespace
