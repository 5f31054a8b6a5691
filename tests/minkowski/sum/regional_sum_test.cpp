// SPDX-License-Identifier: Apache-2.0
//
// Sums of sets in tiles against sums of the same sets as a whole.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "apps/minkowski/in_tiles.h"
#include "apps/minkowski/sum/regional_sum.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/io/native/native_binary.h"
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

// A star-shaped body with waves, concave in many places, of 2 n (n - 1) triangles.
Polyhedron wavy_ball(std::size_t n) {
  const double pi = std::acos(-1.0);
  nef::Mesh mesh;
  const auto add = [&](double x, double y, double z) {
    mesh.vertices.push_back({Rational(std::lround(x)), Rational(std::lround(y)), Rational(std::lround(z))});
  };
  add(0, 0, 1000);
  for (std::size_t i = 1; i < n; ++i) {
    const double theta = pi * static_cast<double>(i) / static_cast<double>(n);
    for (std::size_t j = 0; j < n; ++j) {
      const double phi = 2 * pi * static_cast<double>(j) / static_cast<double>(n);
      const double r = 700 + 200 * std::sin(3 * theta) * std::cos(4 * phi) + 40 * std::sin(9 * theta + 7 * phi);
      add(r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
    }
  }
  add(0, 0, -1000);
  const auto corner = [n](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(1 + (i - 1) * n + j % n); };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto add_face = [&mesh](const std::array<std::uint32_t, 3>& face) { mesh.push_face(face); };
  for (std::size_t j = 0; j < n; ++j) {
    add_face({0, corner(1, j), corner(1, j + 1)});
    add_face({last, corner(n - 1, j + 1), corner(n - 1, j)});
    for (std::size_t i = 1; i + 1 < n; ++i) {
      add_face({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      add_face({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return nef::from_mesh(mesh);
}

// Large sums look for vertices in runs of intervals, each on a thread of its own; the regions of this one are below one
// run each.
TEST_CASE("A sum whose vertices are found in several runs is that of its regions, on any number of threads",
          "[threads]") {
  const Polyhedron scan = wavy_ball(64);
  const Polyhedron cube = set("box(-9,-9,-9,9,9,9)");
  const auto sum_on = [&](std::size_t threads, MinkowskiReport& report) {
    return minkowski_sum(scan, cube, {.monitor = Monitor().on_threads(threads)}, &report);
  };
  MinkowskiReport one;
  const Polyhedron whole = sum_on(1, one);
  CHECK(one.convolution_intervals > 2 * 8192);
  CHECK(nef::validate(whole.complex()).empty());
  for (const std::size_t threads : {2, 3}) {
    MinkowskiReport report;
    const Polyhedron other = sum_on(threads, report);
    CHECK(report.convolution_points == one.convolution_points);
    CHECK((nef::native_binary(other) == nef::native_binary(whole)));
  }
  MinkowskiReport by_parts;
  const TiledPolyhedron regional = minkowski_sum(TiledPolyhedron(scan, {.limit = 512}), cube, {}, &by_parts);
  CHECK_THAT(by_parts.choices.at(0).why, Catch::Contains(" regions"));
  CHECK(equal(regional.polyhedron(), whole));
}

}  // namespace
