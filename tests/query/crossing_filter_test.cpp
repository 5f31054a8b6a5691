// SPDX-License-Identifier: Apache-2.0
//
// What doubles tell of edges and facets, against Booleans of the segment and the facet as sets.
#include "nef/distance/crossing_filter.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "nef/base/fast_path.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::EdgeCrossing;
using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::test::set;

nef::Approximation3 near(const Rational3& p) {
  return {nef::approximation_of(p[0]), nef::approximation_of(p[1]), nef::approximation_of(p[2])};
}

// Of the few cases that the sanitizers try, none may be of a kind: each answer is checked there, but they are not
// counted.
#ifdef NEF_SANITIZED
constexpr bool kManyCases = false;
#else
constexpr bool kManyCases = true;
#endif

// A point of a grid of thirds, or next to one.
Rational3 random_point() {
  Rational3 p;
  for (Rational& x : p) {
    x = Rational(*rc::gen::inRange(-3, 16), 3);
    if (*rc::gen::inRange(0, 4) == 0) x += Rational(*rc::gen::inRange(-2, 3)) / Rational(nef::Integer(1) << 55);
  }
  return p;
}

TEST_CASE("crossing filter: what is sure is so") {
  // One facet each: with a hole, not convex, oblique.
  const std::vector<Polyhedron> facets = {
      set("closure(hull(0,0,1, 4,0,1, 4,4,1, 0,4,1) - hull(1,1,1, 2,1,1, 2,3,1, 1,3,1))"),
      set("hull(0,0,0, 3,0,3, 0,3,0) + hull(0,0,0, 3,0,3, 3,-1,3)"),
      set("closure(hull(0,0,0, 4,1,2, 4,5,6, 0,4,4) - hull(0,0,0, 4,1,2, 2,2,5/2))")};
  std::array<int, 3> told{};
  nef::test::check("segments", 600, [&] {
    const Polyhedron& facet = facets[static_cast<std::size_t>(*rc::gen::inRange(0, 3))];
    const nef::Complex& c = facet.complex();
    RC_PRE(c.facet_count() == 1);
    std::vector<Rational3> points;
    for (const nef::VertexId v : c.vertex_ids()) points.push_back(c.points.rational(nef::point_of(v)));
    const Rational3 from = random_point();
    const Rational3 to = random_point();
    RC_PRE(from != to);
    const nef::CrossingFilter filter(c, points);
    const EdgeCrossing answer = filter.ask(nef::FacetId{0U}, near(from), near(to));
    ++told[static_cast<std::size_t>(answer)];
    if (answer == EdgeCrossing::kUnsure) return;
    const Polyhedron common = nef::intersect(facet, nef::make_segment(from, to));
    if (answer == EdgeCrossing::kApart) {
      RC_ASSERT(common.is_empty());
      return;
    }
    RC_ASSERT(common.complex().vertex_count() == 1U);
    const Rational3 at = common.complex().points.rational(nef::PointId{0U});
    RC_ASSERT(nef::locate(facet, at).kind == nef::Location::Kind::kFacet);
    RC_ASSERT(at != from);
    RC_ASSERT(at != to);
  });
  if (!kManyCases) return;
  if (nef::kFastPaths) {
    CHECK(told[0] > 0);
    CHECK(told[1] > 0);
  }
  CHECK(told[2] > 0);
}

// A plate with 120 teeth of unequal height, oblique in space: its facets are asked by rows.
TEST_CASE("crossing filter: facets with many corners are told by rows") {
  std::vector<Rational3> plate;
  std::string comb = "hull(0,0,0, 240,0,240, 240,-2,240, 0,-2,0)";
  for (int i = 0; i < 120; ++i) {
    const std::string from = std::to_string(2 * i);
    const std::string to = std::to_string(2 * i + 2);
    const std::string tip = std::to_string(2 * i + 1);
    comb += " + hull(" + from + ",0," + from + ", " + to + ",0," + to + ", " + tip + "," +
            std::to_string(3 + i * 7 % 5) + "," + tip + ")";
  }
  const Polyhedron facet = set(comb);
  const nef::Complex& c = facet.complex();
  REQUIRE(c.facet_count() == 1);
  for (const nef::VertexId v : c.vertex_ids()) plate.push_back(c.points.rational(nef::point_of(v)));
  REQUIRE(plate.size() > 200);
  const nef::CrossingFilter filter(c, plate);
  std::array<int, 3> told{};
  nef::test::check("segments", 300, [&] {
    const Rational x(*rc::gen::inRange(-3, 730), 3);
    const Rational y(*rc::gen::inRange(-10, 30), 3);
    const Rational3 from = {x, y, Rational(x - *rc::gen::inRange(1, 4))};
    const Rational3 to = {x, Rational(y + Rational(*rc::gen::inRange(-2, 3), 7)),
                          Rational(x + *rc::gen::inRange(0, 3))};
    const EdgeCrossing answer = filter.ask(nef::FacetId{0U}, near(from), near(to));
    ++told[static_cast<std::size_t>(answer)];
    if (answer == EdgeCrossing::kUnsure) return;
    const Polyhedron common = nef::intersect(facet, nef::make_segment(from, to));
    RC_ASSERT(common.is_empty() == (answer == EdgeCrossing::kApart));
    if (answer == EdgeCrossing::kApart) return;
    const Rational3 at = common.complex().points.rational(nef::PointId{0U});
    RC_ASSERT(nef::locate(facet, at).kind == nef::Location::Kind::kFacet);
  });
  if (kManyCases && nef::kFastPaths) {
    CHECK(told[0] > 30);
    CHECK(told[1] > 30);
  }
}

}  // namespace
