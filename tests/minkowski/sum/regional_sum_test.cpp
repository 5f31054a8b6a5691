// SPDX-License-Identifier: Apache-2.0
//
// Sums of sets in tiles against sums of the same sets as a whole.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "apps/minkowski/in_tiles.h"
#include "apps/minkowski/sum/regional_sum.h"
#include "nef/base/error.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::equal;
using nef::Monitor;
using nef::Polyhedron;
using nef::Rational;
using nef::TiledPolyhedron;
using nef::TileRef;
using nef::minkowski::closing;
using nef::minkowski::erode;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiReport;
using nef::minkowski::offset;
using nef::minkowski::opening;
using nef::minkowski::RegionalSum;
using nef::minkowski::Side;
using nef::test::recipes;
using nef::test::set;

Polyhedron by_regions(const RegionalSum& sum) {
  std::vector<TileRef> trees;
  MinkowskiReport report;
  for (std::size_t i = 0; i < sum.region_count(); ++i) trees.push_back(sum.compute(i, {}, report));
  return sum.whole(trees).polyhedron();
}

TEST_CASE("sums and erosions by regions are those of the whole, for sets of all kinds") {
  CHECK(rc::check("regions", [] {
    const Polyhedron a = (*recipes(true, 4)).make();
    const Polyhedron b = transform((*recipes(true, 2)).make(),
                                   nef::AffineMap::scale({Rational(1, 16), Rational(1, 24), Rational(1, 16)}));
    if (a.is_empty() || b.is_empty()) return;
    const TiledPolyhedron tiled(a, {.limit = 16});
    const RegionalSum sum(RegionalSum::Kind::kSum, tiled, b, {}, 16);
    RC_ASSERT(equal(by_regions(sum), minkowski_sum(a, b)));
    RC_ASSERT(equal(by_regions(RegionalSum(RegionalSum::Kind::kErosion, tiled, b, {}, 16)), erode(a, b)));
  }));
}

TEST_CASE("many regions together are the whole sum") {
  const Polyhedron a = set("box(0,0,0,8,8,8) - box(1,1,1,2,2,2) - box(5,5,5,6,6,6) - box(1,5,1,2,6,2)");
  const Polyhedron b = set("box(0,0,0, 1/8,1/8,1/8)");
  const TiledPolyhedron tiled(a, {.limit = 16});
  const RegionalSum sum(RegionalSum::Kind::kSum, tiled, b, {}, 8);
  CHECK(sum.region_count() > 2);
  CHECK(equal(by_regions(sum), minkowski_sum(a, b)));
  CHECK(equal(by_regions(RegionalSum(RegionalSum::Kind::kErosion, tiled, b, {}, 8)), erode(a, b)));
}

TEST_CASE("regions are not narrower than B, and trivial sets are summed as a whole") {
  const Polyhedron a = set("box(0,0,0,8,8,8) - box(1,1,1,2,2,2) - box(5,5,5,6,6,6) - box(1,5,1,2,6,2)");
  const TiledPolyhedron tiled(a, {.limit = 16});
  const auto regions = [&](const std::string& b) {
    return RegionalSum(RegionalSum::Kind::kSum, tiled, set(b), {}, 8).region_count();
  };
  CHECK(regions("box(0,0,0,1/8,1/8,1/8)") > 3);
  CHECK(regions("box(0,0,0,3,3,3)") == 1);
  const Polyhedron cube = set("box(0,0,0,1,1,1)");
  CHECK(minkowski_sum(TiledPolyhedron(), cube).is_empty());
  CHECK(minkowski_sum(TiledPolyhedron(set("everything")), cube).is_everything());
  CHECK(erode(tiled, Polyhedron()).is_everything());
  CHECK_THROWS_AS(minkowski_sum(TiledPolyhedron(set("!box(0,0,0,1,1,1)")), cube), nef::UnsupportedError);
  CHECK_THROWS_AS(minkowski_sum(TiledPolyhedron(set("halfspace(1,0,0,0)")), cube), nef::UnsupportedError);
  CHECK_THROWS_AS(minkowski_sum(tiled, set("halfspace(1,0,0,0)")), nef::UnsupportedError);
  CHECK_THROWS_AS(opening(tiled, Polyhedron()), nef::InputError);
}

TEST_CASE("offsets, openings and closings in tiles are those of the whole, on two threads, too") {
  const Polyhedron a = set("(box(0,0,0,8,8,8) - interior(box(2,2,-1,5,5,9))) + box(6,6,7,7,7,9) - box(6,1,6,7,2,9)");
  const TiledPolyhedron tiled(a, {.limit = 32});
  for (const Rational& radius : {Rational(1, 4), Rational(-1, 4), Rational(0)}) {
    for (const Side side : {Side::kInner, Side::kOuter}) {
      MinkowskiReport report;
      const TiledPolyhedron grown = offset(tiled, radius, 2, side, {.monitor = Monitor().on_threads(2)}, &report);
      CHECK(equal(grown.polyhedron(), offset(a, radius, 2, side)));
      if (sgn(radius) != 0) CHECK_THAT(report.choices.at(0).why, Catch::Contains(" regions"));
    }
  }
  const Polyhedron cube = set("box(0,0,0,1,1,1)");
  CHECK(equal(opening(tiled, cube).polyhedron(), opening(a, cube)));
  CHECK(equal(closing(tiled, cube).polyhedron(), closing(a, cube)));
}

}  // namespace
