// SPDX-License-Identifier: Apache-2.0
//
// Sums from the reduced convolution (apps/minkowski/convolution/) against the other strategies, and against the
// definition: x is in A + B iff A meets x - B. Solids on a grid, which touch and cover each other in every way, and the
// same turned and moved by next to nothing, so that doubles can not tell.
#include <rapidcheck.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/minkowski/convolution/convolution_sum.h"
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/minkowski/sum/strategy_choice.h"
#include "nef/construct/construct.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/machine_parts.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/shapes/random_polyhedra.h"
#include "tests/support/sums_two_ways.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::MinkowskiReport;
using nef::minkowski::UnionStrategy;
using nef::test::by_cells;
using nef::test::check;
using nef::test::convolution;
using nef::test::moved;
using nef::test::recipes;
using nef::test::valid;

// Turned, so that no plane is parallel to an axis; sheared by next to nothing, or not.
Polyhedron disturbed(const Polyhedron& a, int step) {
  nef::AffineMap map = nef::AffineMap::identity();
  const Rational tiny = Rational(step, 3) / Rational(nef::Integer(1) << 60);
  const int m[3][3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) map.linear[i][j] = Rational(m[i][j], 3);
    map.linear[i][(i + 1) % 3] += tiny;
  }
  return nef::transform(a, map);
}

TEST_CASE("convolution: solids on a grid") {
  check("grid", 300, [] {
    const Polyhedron a = nef::regularize((*recipes(true, 5)).make());
    const Polyhedron b = nef::regularize((*recipes(true, 3, 2)).make());
    RC_PRE(!a.is_empty() && !b.is_empty());
    const Polyhedron sum = convolution(a, b);
    RC_ASSERT(nef::equal(sum, by_cells(a, b)));
    const Polyhedron turned = nef::minkowski::negate(b);
    for (std::uint32_t v = 0; v < sum.complex().vertex_count(); v += 5) {
      Rational3 x = sum.complex().points.rational(nef::PointId{v});
      for (const int k : {0, 1}) {  // on the boundary, and near it
        x[static_cast<std::size_t>(v % 3)] += Rational(k, 7);
        RC_ASSERT(nef::contains(sum, x) == !nef::intersect(a, moved(turned, x)).is_empty());
      }
    }
  });
}

// Facets that overlap in one plane, and facets that are nearly parallel, meet a segment at points whose order doubles
// can not tell. What lies between them may be all of the segment that is on the boundary.
TEST_CASE("convolution: an edge that lies within one cut of a segment") {
  const Polyhedron a = nef::test::set(
      "regularize(regularize(regularize(regularize(regularize(nothing + hull(0,2,0, 5/2,2,0, 0,9/2,0, 5/2,9/2,0, 0,2,2,"
      "5/2,2,2, 0,9/2,2, 5/2,9/2,2)) - hull(1,2,0, 3,2,0, 1,3,0, 3,3,0, 1,2,5/2, 3,2,5/2, 1,3,5/2, 3,3,5/2)) +"
      "hull(4,3,1, 1,3,3, 4,4,1, 1,2,4)) - hull(2,4,4, 0,1,3, 3,1,4, 0,1,0, 0,2,2, 2,3,3)) +"
      "hull(2,2,0, 7/2,2,0, 2,9/2,0, 7/2,9/2,0, 2,2,2, 7/2,2,2, 2,9/2,2, 7/2,9/2,2))");
  const Polyhedron b = nef::test::set(
      "regularize(regularize(regularize(nothing + hull(0,0,0, 1,1,1, 2,2,1, 2,1,1, 0,1,2)) - hull(1,0,2, 0,1,0, 2,1,2,"
      "0,2,2, 0,0,1)) + hull(0,1,0, 1,1,0, 0,5/2,0, 1,5/2,0, 0,1,3/2, 1,1,3/2, 0,5/2,3/2, 1,5/2,3/2))");
  nef::AffineMap shear = nef::AffineMap::identity();
  shear.linear[1][0] = Rational(1, 3) / Rational(nef::Integer(1) << 60);
  const Polyhedron sheared = nef::transform(b, shear);
  CHECK(nef::equal(convolution(a, sheared), by_cells(a, sheared)));
}

// Both, if the convolution was taken, which it need not be: with pieces of dimension 2 and less it is not.
bool sums_agree(const Polyhedron& a, const Polyhedron& b, MinkowskiReport* report = nullptr) {
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kConvolution;
  const Polyhedron sum = valid(minkowski_sum(a, b, options, report), "sum");
  return nef::equal(sum, by_cells(a, b));
}

// Solids with any part of their boundary, and with points, segments and facets missing inside.
TEST_CASE("convolution: open solids and such with parts of their boundary, on a grid") {
  check("marks", 300, [] {
    const Polyhedron full_a = (*recipes(true, 5)).make();
    const Polyhedron full_b = (*recipes(true, 3, 2)).make();
    // What is no part of the closure of the interior goes.
    const Polyhedron a = nef::intersect(full_a, nef::regularize(full_a));
    const Polyhedron b = nef::intersect(full_b, nef::regularize(full_b));
    RC_PRE(!a.is_empty() && !b.is_empty());
    RC_ASSERT(sums_agree(a, b));
    RC_ASSERT(sums_agree(nef::interior(a), b));
    RC_ASSERT(sums_agree(a, nef::interior(nef::closure(b))));
  });
}

// A segment that is not in the sum separates two facets of the convolution in one plane: where another facet crosses
// it, the sum has a vertex that no three planes of facets tell of.
TEST_CASE("convolution: a tetrahedron without a segment in its boundary, and a box with a tetrahedron") {
  const Polyhedron full_a = nef::test::set("box(0,1,0,1,2,1) + hull(0,0,0,2,0,0,1,2,2,0,1,0)");
  const Polyhedron full_b = nef::test::set("hull(2,0,1,0,1,0,0,0,0,0,0,1) ^ hull(0,0,0,0,0,0,2,2,1)");
  CHECK(sums_agree(nef::intersect(full_a, nef::regularize(full_a)), nef::intersect(full_b, nef::regularize(full_b))));
}

TEST_CASE("convolution: solids with parts of their boundary that are turned, and all but parallel") {
  check("turned marks", 150, [] {
    const Polyhedron full_a = (*recipes(true, 4)).make();
    const Polyhedron full_b = (*recipes(true, 3, 2)).make();
    const Polyhedron a = disturbed(nef::intersect(full_a, nef::regularize(full_a)), 0);
    const Polyhedron b = disturbed(nef::intersect(full_b, nef::regularize(full_b)), *rc::gen::inRange(-1, 2));
    RC_PRE(!a.is_empty() && !b.is_empty());
    RC_ASSERT(sums_agree(a, b));
    RC_ASSERT(sums_agree(nef::interior(a), b));
  });
}

// Where the open robot just does not fit: slots, shafts, pockets, and one that fits in no direction at all.
TEST_CASE("convolution: passages as wide as what passes") {
  const Polyhedron slot = nef::test::set("interior(box(0,0,0,9,9,3) - box(4,-1,1,5,10,4))");
  const Polyhedron shaft = nef::test::set("interior(box(0,0,0,9,9,9) - box(4,4,-1,5,5,10))");
  const Polyhedron pocket = nef::test::set("interior(box(0,0,0,9,9,9) - box(4,4,4,5,5,5))");
  const Polyhedron corner = nef::test::set("interior(box(0,0,0,9,9,9) - hull(4,4,4, 6,4,4, 4,6,4, 4,4,6))");
  const Polyhedron cube = nef::test::set("box(0,0,0,1,1,1)");
  const Polyhedron tip = nef::minkowski::negate(nef::test::set("hull(0,0,0, 2,0,0, 0,2,0, 0,0,2)"));
  // Three rods that meet in a point, and a block that leaves just a little more room around them.
  const Polyhedron rods = nef::test::set(
      "hull(0,0,0, 4,1,0, 4,0,1, 4,-1,0, 4,0,-1) + hull(0,0,0, 1,4,0, 0,4,1, -1,4,0, 0,4,-1) +"
      "hull(0,0,0, 1,0,4, 0,1,4, -1,0,4, 0,-1,4)");
  const Polyhedron block = nef::test::set(
      "box(-3,-3,-3,3,3,3) - hull(0,0,0, 8,3,0, 8,0,3, 8,-3,0, 8,0,-3) - hull(0,0,0, 3,8,0, 0,8,3, -3,8,0, 0,8,-3) -"
      "hull(0,0,0, 3,0,8, 0,3,8, -3,0,8, 0,-3,8)");
  const std::vector<std::pair<Polyhedron, Polyhedron>> pairs = {
      {slot, nef::minkowski::negate(cube)},   {shaft, nef::minkowski::negate(cube)},
      {pocket, nef::minkowski::negate(cube)}, {corner, tip},
      {block, nef::minkowski::negate(rods)},  {nef::interior(block), nef::minkowski::negate(rods)}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    CAPTURE(i);
    const auto& [a, b] = pairs[i];
    CHECK(nef::equal(convolution(a, b), by_cells(a, b)));
    CHECK(nef::equal(convolution(a, nef::interior(b)), by_cells(a, nef::interior(b))));
  }
  CHECK(nef::counts(convolution(pocket, nef::minkowski::negate(cube))).vertices == 9);  // a point is missing
}

// A passage goes straight on where the walls become part of the solid, and there it ends. A point that stood for all
// that is just beyond a vertex was taken at the very place where the marks change.
TEST_CASE("convolution: a passage as wide as what passes that ends where it goes straight on") {
  const Polyhedron a = nef::test::set("box(-3,-3,-3,6,6,6) - (box(0,0,0,2,1,1) + interior(box(2,0,0,3,1,1)))");
  const Polyhedron b = nef::test::set("box(-1,-1,-1,0,0,0)");
  CHECK(nef::equal(convolution(a, b), nef::test::set("box(-4,-4,-4,6,6,6) - hull(0,0,0, 1,0,0)")));
  const Polyhedron parts = nef::test::set("box(0,0,0,2,1,1) + interior(box(0,1,1,1,2,2)) + interior(box(2,0,0,3,1,1))");
  const Polyhedron cube = nef::test::set("box(0,0,0,1,1,1)");
  CHECK(nef::equal(nef::minkowski::erode(parts, cube), nef::test::set("hull(0,0,0, 1,0,0)")));
  CHECK(nef::equal(nef::minkowski::opening(parts, cube), nef::test::set("box(0,0,0,2,1,1)")));
}

// The sum need not have the marks of its facets throughout: parts of their sides add to them, too.
TEST_CASE("convolution: marks of parallel facets and edges") {
  const std::vector<std::string> sets = {
      "box(0,0,0,2,2,2)",
      "interior(box(0,0,0,1,3,2))",
      "box(0,0,0,2,2,2) - box(1,-1,1,3,3,3)",
      "box(0,0,0,2,1,2) - segment(0,0,0,2,0,0)",
      "box(0,0,0,2,1,2) - segment(0,0,0,1,0,0)",
      "box(0,0,0,1,1,1) - polygon(0,0,1, 1,0,1, 1,1,1, 0,1,1) + segment(0,0,1, 1,0,1)",
      "interior(box(0,0,0,2,2,1)) + point(0,0,0)",
      "interior(box(0,0,0,2,2,1)) + polygon(1,0,0, 2,0,0, 2,2,0, 1,2,0)",
      "interior(box(0,0,0,2,2,2)) + segment(0,0,0,2,0,0) + segment(0,0,2,2,0,2) + segment(0,0,0,0,0,2)",
      "box(0,0,0,4,4,4) - box(1,1,1,3,3,3)",
      "hull(0,0,0,2,0,0,0,2,0,0,0,2) - hull(0,0,0,2,0,0,0,2,0)"};
  for (const std::string& one : sets) {
    for (const std::string& other : sets) {
      CAPTURE(one, other);
      MinkowskiReport report;
      CHECK(sums_agree(nef::test::set(one), nef::test::set(other), &report));
      CHECK(report.choices.at(0).chosen == "convolution");
    }
  }
}

// Facets that are not in their sets, with sides, parts of sides and corners that are.
TEST_CASE("convolution: parts of a facet's border without the facet") {
  const std::vector<std::string> sets = {
      "interior(box(0,0,0,2,2,2)) + segment(0,0,0,2,0,0)",
      "interior(box(0,0,0,2,2,2)) + segment(0,0,2,1,0,2) + point(2,2,2)",
      "interior(box(0,0,0,3,3,1) - box(1,1,-1,2,2,2)) + segment(1,1,0,2,1,0) + segment(0,0,1,0,3,1)",
      "interior(hull(0,0,0,3,0,0,0,3,0,0,0,2)) + segment(0,0,0,3,0,0) + point(0,3,0)",
      "interior(hull(0,0,0,3,0,0,1,2,0,0,0,2,2,0,2,1,1,2)) + segment(0,0,2,2,0,2) + segment(3,0,0,1,2,0)",
      "box(0,0,0,1,2,1) - polygon(0,0,0, 1,0,0, 1,2,0, 0,2,0) + segment(0,0,0,1,0,0) + segment(0,2,0,0,1,0)"};
  for (const std::string& one : sets) {
    for (const std::string& other : sets) {
      CAPTURE(one, other);
      const Polyhedron a = nef::test::set(one);
      const Polyhedron b = nef::test::set(other);
      MinkowskiReport report;
      CHECK(sums_agree(a, b, &report));
      CHECK(sums_agree(a, nef::minkowski::negate(b), &report));
      for (const auto& choice : report.choices) CHECK(choice.chosen == "convolution");
    }
  }
}

TEST_CASE("convolution: a facet around an edge that ends inside of it is not convex") {
  const Polyhedron a =
      nef::test::set("regularize(box(0,0,2,3,1,3) - hull(0,1,3,2,0,2,0,0,0,1,0,2)) + box(0,0,0,2,1,2)");
  const Polyhedron b = nef::test::set("box(0,0,0,1,1,1)");
  CHECK(nef::equal(convolution(a, b), by_cells(a, b)));
}

TEST_CASE("convolution: straight corners, of which three span no plane") {
  const Polyhedron a = nef::test::set("hull(0,1,0,1,2,2,0,0,0,0,0,2) + box(0,0,2,1,1,3)");
  const Polyhedron b = nef::test::set("box(0,0,0,1,1,1)");
  CHECK(nef::equal(convolution(a, b), by_cells(a, b)));
}

TEST_CASE("convolution: facets that continue each other without a common side") {
  const Polyhedron a = nef::test::set("box(0,0,0,2,1,1) + hull(1,0,2,1,2,1,2,0,0,0,0,2)");
  const Polyhedron b = nef::test::set("box(0,0,0,1,1,1)");
  CHECK(nef::equal(convolution(a, b), by_cells(a, b)));
}

TEST_CASE("convolution: a point on the line of a segment, but not on the segment") {
  const Polyhedron a = nef::test::set("box(0,0,0,1,1,1) + box(0,1,1,1,2,2) + hull(0,0,0,0,0,1,2,2,2,1,0,0)");
  const Polyhedron b = nef::test::set("regularize(hull(2,1,1,2,0,0,0,0,2,1,2,1) - box(0,1,1,1,2,2))");
  CHECK(nef::equal(convolution(a, b), by_cells(a, b)));
}

// The frame and the rod meet in a ring for some x, so the winding number of the full convolution is zero there.
TEST_CASE("convolution: rings, tunnels and cavities") {
  const Polyhedron frame = nef::test::set("box(0,0,0,6,6,1) - interior(box(1,1,-1,5,5,2))");
  const Polyhedron cavity = nef::test::set("box(0,0,0,6,6,6) - interior(box(1,1,1,5,5,5))");
  const Polyhedron two = nef::test::set("box(0,0,0,1,1,1) + box(3,0,0,4,1,1)");
  const Polyhedron rod = nef::test::set("box(0,0,0,1,1,4)");
  const Polyhedron small = nef::test::set("box(0,0,0,1,2,3)");
  const Polyhedron tight = nef::test::set("box(0,0,0,4,4,4)");
  const std::vector<Polyhedron> solids = {frame, cavity, two, rod, small, tight};
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = i; j < solids.size(); ++j) {
      CAPTURE(i, j);
      CHECK(nef::equal(convolution(solids[i], solids[j]), by_cells(solids[i], solids[j])));
    }
  }
}

TEST_CASE("convolution: solids that are turned, and all but parallel") {
  check("turned", 150, [] {
    const Polyhedron a = disturbed(nef::regularize((*recipes(true, 4)).make()), 0);
    const Polyhedron b = disturbed(nef::regularize((*recipes(true, 3, 2)).make()), *rc::gen::inRange(-1, 2));
    RC_PRE(!a.is_empty() && !b.is_empty());
    RC_ASSERT(nef::equal(convolution(a, b), by_cells(a, b)));
  });
}

// The same complex, not only the same set.
void check_any_threads(const Polyhedron& a, const Polyhedron& b) {
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kConvolution;
  const Polyhedron one = minkowski_sum(a, b, options);
  options.monitor = nef::Monitor().on_threads(3);
  const Polyhedron three = minkowski_sum(a, b, options);
  const nef::Complex& c = one.complex();
  const nef::Complex& d = three.complex();
  REQUIRE(c.vertex_count() == d.vertex_count());
  for (const nef::VertexId v : c.vertex_ids()) {
    CHECK(c.points.rational(nef::point_of(v)) == d.points.rational(nef::point_of(v)));
  }
  CHECK(nef::equal(one, three));
}

TEST_CASE("convolution: any number of threads gives the same complex", "[threads]") {
  const Polyhedron mushroom = nef::from_mesh(nef::test::mushroom());
  const Polyhedron ball = to_polyhedron(nef::minkowski::ball_approximation(1, 2, nef::minkowski::Side::kInner).cell);
  check_any_threads(mushroom, ball);
  check_any_threads(nef::interior(mushroom), ball);
  check_any_threads(nef::subtract(nef::test::set("box(0,0,0,6,6,6)"), mushroom), ball);
  check_any_threads(nef::test::set("box(0,0,0,6,6,6) - interior(box(1,1,1,5,5,5))"),
                    nef::test::set("box(0,0,0,4,4,4)"));
  // Large enough for several ranges of facets, corners and vertices.
  check_any_threads(mushroom,
                    to_polyhedron(nef::minkowski::ball_approximation(1, 16, nef::minkowski::Side::kInner).cell));
}

// Where parts have coplanar and coaxial faces, most points at which facets meet lie in the middle of a face or an edge
// of the sum, and nothing has to be asked about the regions around them.
TEST_CASE("convolution: few regions of coplanar and coaxial parts are put to the definition") {
  const Polyhedron gear = nef::from_mesh(nef::test::extruded_part(nef::test::gear_outline(8, 9, 1.2), 6));
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kConvolution;
  MinkowskiReport report;
  const Polyhedron sum = valid(minkowski_sum(gear, gear, options, &report), "sum");
  CHECK(nef::equal(sum, by_cells(gear, gear)));
  CHECK(report.convolution_points > 300);
  CHECK(report.convolution_regions * 2 < report.convolution_points);
}

// What is chosen without being told. Parts have parallel facets of many pieces.
TEST_CASE("convolution: the default takes it for solids, but not for two convex ones") {
  const Polyhedron ring = nef::from_mesh(nef::test::turned_part(nef::test::kBushing, 12, 0));
  const Polyhedron other = nef::test::moved(nef::minkowski::negate(ring), {Rational(1), Rational(2), Rational(3)});
  const Polyhedron gear = nef::from_mesh(nef::test::extruded_part(nef::test::gear_outline(6, 9, 1.2), 6));
  const Polyhedron cube = nef::test::set("box(0,0,0,1,1,1)");
  const auto chosen = [](const Polyhedron& a, const Polyhedron& b) {
    MinkowskiReport report;
    minkowski_sum(a, b, {}, &report);
    REQUIRE(report.choices.size() == 1);
    return report.choices[0].chosen;
  };
  CHECK(chosen(ring, other) == "convolution");
  CHECK(chosen(gear, gear) == "convolution");
  CHECK(chosen(cube, cube) != "convolution");
}

TEST_CASE("convolution: cells are chosen where few pairs of them face many facets") {
  const Polyhedron cross = nef::test::set("box(0,0,0, 3,1,1) + box(1,-1,0, 2,2,1)");
  const auto sum_with = [&](unsigned parts, MinkowskiReport& report) {
    return valid(minkowski_sum(cross, nef::minkowski::inner_ball(1, parts), {}, &report), "sum");
  };
  MinkowskiReport small;
  sum_with(4, small);
  CHECK(small.choices.at(0).chosen == "convolution");
  MinkowskiReport large;
  const Polyhedron sum = sum_with(8, large);
  CHECK(large.choices.at(0).chosen == "queue");
  CHECK_THAT(large.choices.at(0).why, Catch::StartsWith("the convolution has many facets for so few pairs of cells"));
  CHECK(large.choices.at(0).pairs_of_cells == 5);
  nef::minkowski::MinkowskiOptions options;
  options.strategy = nef::minkowski::UnionStrategy::kConvolution;
  CHECK(nef::equal(sum, minkowski_sum(cross, nef::minkowski::inner_ball(1, 8), options)));
}

TEST_CASE("convolution: each facet of a sheet and each part counts as a cell") {
  nef::Mesh sheet;  // of 288 triangles, no two of which are in one plane
  for (int x = 0; x <= 12; ++x) {
    for (int y = 0; y <= 12; ++y)
      sheet.vertices.push_back({Rational(x), Rational(y), Rational(x * x + y * y + x * y, 9)});
  }
  for (std::uint32_t x = 0; x < 12; ++x) {
    for (std::uint32_t y = 0; y < 12; ++y) {
      const std::uint32_t at = 13 * x + y;
      sheet.push_face(std::array<std::uint32_t, 3>{at, at + 13, at + 14});
      sheet.push_face(std::array<std::uint32_t, 3>{at, at + 14, at + 1});
    }
  }
  const auto pairs_with = [](const Polyhedron& a, const Polyhedron& b, std::string& chosen) {
    MinkowskiReport report;
    minkowski_sum(a, b, {}, &report);
    chosen = report.choices.at(0).chosen;
    return report.choices.at(0).pairs_of_cells;
  };
  std::string chosen;
  const Polyhedron ball = nef::minkowski::inner_ball(1, 2);
  CHECK(pairs_with(nef::from_mesh(sheet, {.as_surface = true}), ball, chosen) == 288);
  CHECK(chosen == "convolution");
  CHECK(pairs_with(nef::test::set("box(0,0,0,1,1,1) + box(2,0,0,3,1,1) + box(4,0,0,5,1,1)"),
                   nef::test::set("box(0,0,0,1,1,1) + box(9,0,0,10,1,1)"), chosen) == 6);
}

TEST_CASE("convolution: where there are far more cells than was estimated, it is taken after all") {
  const Polyhedron cross = nef::test::set("box(0,0,0, 3,1,1) + box(1,-1,0, 2,2,1)");
  const Polyhedron ball = nef::minkowski::inner_ball(1, 8);
  nef::minkowski::Summand a(cross);
  nef::minkowski::Summand b(ball);
  MinkowskiReport report;
  nef::minkowski::StrategyChoice choice;
  const nef::minkowski::TriedConvolution tried = sum_by_convolution(a, b, {}, report, choice);
  CHECK(!tried.sum);
  CHECK(tried.is_put_off);
  CHECK(!sum_by_convolution_after_all(a, b, 64, {}, report, choice));
  const auto sum = sum_by_convolution_after_all(a, b, 65, {}, report, choice);
  REQUIRE(sum);
  CHECK(choice.chosen == "convolution");
  CHECK(choice.why == "there are 65 pairs of cells, far more than was estimated");
  CHECK(nef::equal(*sum, minkowski_sum(cross, ball)));
}

TEST_CASE("convolution: the report says what each way has to do") {
  const Polyhedron corner = nef::test::set("regularize(box(0,0,0,2,2,2) - box(1,1,-1,3,3,3))");  // one reflex edge
  const Polyhedron step = nef::test::set("regularize(box(0,0,0,3,1,3) - box(1,-1,2,2,2,4))");    // two
  MinkowskiReport report;
  minkowski_sum(corner, step, {}, &report);
  REQUIRE(report.choices.size() == 1);
  CHECK(report.choices[0].pairs_of_cells == 6);
  CHECK(report.choices[0].convolution_facets == report.convolution_facets);
  CHECK(report.convolution_facets > 10);
}

}  // namespace
