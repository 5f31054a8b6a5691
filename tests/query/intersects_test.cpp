// SPDX-License-Identifier: Apache-2.0
//
// Whether two sets meet, against their intersection: sets on a grid, open, closed and of any dimension, moved so that
// they touch in every way, or by a little less or more.
#include "nef/distance/intersects.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::AffineMap;
using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::test::check;
using nef::test::recipes;
using nef::test::set;

bool by_intersection(const Polyhedron& a, const Polyhedron& b, const Rational3& by) {
  return !nef::intersect(a, nef::transform(b, AffineMap::translate(by))).is_empty();
}

TEST_CASE("intersects: as the intersection says, for sets on a grid") {
  check("grid", 500, [] {
    const Polyhedron a = (*recipes(true, 4)).make();
    const Polyhedron b = (*recipes(true, 3, 2)).make();
    const nef::IntersectionQuery query(a, b);
    for (int k = 0; k < 4; ++k) {
      Rational3 by;
      for (Rational& x : by) x = Rational(*rc::gen::inRange(-3, 5));
      if (k % 2 == 1) by[static_cast<std::size_t>(k / 2)] += Rational(1, 3);
      RC_ASSERT(query.meet(by) == by_intersection(a, b, by));
    }
  });
}

// At the middle and the corners of a box of translations.
bool meet_everywhere(const nef::IntersectionQuery& query, const Rational3& middle, const Rational& error) {
  bool all = query.meet(middle);
  for (unsigned corner = 0; corner < 8 && all; ++corner) {
    Rational3 by = middle;
    for (unsigned i = 0; i < 3; ++i) by[i] += (corner >> i & 1U) != 0 ? error : Rational(-error);
    all = query.meet(by);
  }
  return all;
}

TEST_CASE(
    "intersects: where edges surely cross facets, the insides of solids meet at all translations within the errors") {
  std::size_t asked = 0;
  std::size_t crossings = 0;
  check("crossings", 300, [&] {
    const Polyhedron a = nef::regularize((*recipes(true, 4)).make());
    const Polyhedron b = nef::regularize((*recipes(true, 3, 2)).make());
    const nef::IntersectionQuery query(a, b);
    const nef::IntersectionQuery of_insides(nef::interior(a), nef::interior(b));
    nef::IntersectionQuery::Crossings recent;
    for (int k = 0; k < 6; ++k) {
      Rational3 by;
      for (Rational& x : by) x = Rational(2 * *rc::gen::inRange(-8, 16) + 1, 8);  // edges are beside corners
      const Rational error(k % 3, 16);
      nef::Approximation3 near;
      for (std::size_t i = 0; i < 3; ++i) near[i] = {by[i].get_d(), error.get_d()};
      nef::IntersectionQuery::Crossings none;
      ++asked;
      const bool cross = query.surely_cross(near, recent);
      RC_ASSERT(query.surely_cross(near, none) == cross);
      if (!cross) continue;
      ++crossings;
      RC_ASSERT(meet_everywhere(of_insides, by, error));
    }
  });
  // More than 10 of 1800. In a few cases, as under sanitizers, there may be none.
  if (asked > 600) CHECK(180 * crossings > asked);
}

TEST_CASE("intersects: sets of edges and points only") {
  const char* const sets[] = {"hull(0,0,0, 2,0,0)",
                              "hull(0,0,0, 2,0,0) - point(1,0,0)",
                              "hull(0,0,0, 2,0,0) + hull(1,0,0, 1,2,0) + point(0,1,0)",
                              "hull(0,0,0, 2,0,0, 0,2,0) - hull(0,0,0, 2,0,0)",
                              "hull(0,0,0, 2,0,0, 0,2,0) - point(1/2,1/2,0)",
                              "interior(box(0,0,0, 2,2,2)) + point(0,0,0)",
                              "box(0,0,0, 2,2,2) - hull(0,0,0, 2,0,0)",
                              "point(1,1,0)",
                              "interior(box(0,0,0, 3,3,3)) - box(1,1,1, 2,2,2)"};
  for (const char* const first : sets) {
    for (const char* const second : sets) {
      const Polyhedron a = set(first);
      const Polyhedron b = set(second);
      const nef::IntersectionQuery query(a, b);
      for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
          for (int z = -1; z <= 1; ++z) {
            const Rational3 by = {Rational(x), Rational(y), Rational(z)};
            INFO(first << " and " << second << " by " << x << "," << y << "," << z);
            CHECK(query.meet(by) == by_intersection(a, b, by));
          }
        }
      }
    }
  }
}

TEST_CASE("intersects: where a vertex is in the inside of a facet") {
  // The corner of a box, the end of a segment or a point on a facet: the pyramid there is not the facet's.
  const char* const sets[] = {"hull(0,0,0, 4,0,0, 0,4,0, 0,0,-4, 4,4,-1) + hull(1,1,0, 0,1,2, 2,1,2, 1,2,2)",
                              "hull(0,0,0, 4,0,0, 0,4,0, 0,0,-4, 4,4,-1) + hull(1,1,0, 1,1,2)",
                              "hull(0,0,0, 4,0,0, 0,4,0, 0,0,-4, 4,4,-1) - hull(1,1,0, 1,1,-1)",
                              "hull(0,0,0, 4,0,0, 0,4,0, 0,0,-4, 4,4,-1) - point(1,1,0)",
                              "interior(hull(0,0,0, 4,0,0, 0,4,0, 0,0,-4, 4,4,-1)) + point(1,1,0)",
                              "hull(0,0,0, 2,0,0, 2,2,0, 0,2,0) - hull(1,1,0, 1,1,1)"};
  const char* const others[] = {"interior(hull(1,1,0, 0,0,1, 2,0,1, 1,2,1))",
                                "hull(1,1,0, 0,0,1, 2,0,1, 1,2,1)",
                                "hull(1,1,0, 1,1,1)",
                                "hull(0,1,0, 2,1,0)",
                                "hull(0,1,0, 2,1,0) - point(1,1,0)",
                                "interior(hull(0,0,0, 2,0,0, 2,2,0, 0,2,0, 1,1,1, 1,1,-1))",
                                "point(1,1,0)"};
  for (const char* const one : sets) {
    for (const char* const other : others) {
      for (const Rational3& by : {Rational3{0, 0, 0}, Rational3{0, 0, Rational(1, 2)}, Rational3{1, 0, 0}}) {
        INFO(one << " and " << other << " moved by " << by[0] << " " << by[1] << " " << by[2]);
        CHECK(nef::intersects(set(one), set(other), by) == by_intersection(set(one), set(other), by));
        CHECK(nef::intersects(set(other), set(one), by) == by_intersection(set(other), set(one), by));
      }
    }
  }
}

TEST_CASE("intersects: empty and unbounded sets, cavities, and far translations") {
  const Polyhedron cube = set("box(0,0,0, 1,1,1)");
  CHECK_FALSE(nef::intersects(cube, set("nothing")));
  CHECK_FALSE(nef::intersects(set("nothing"), cube));
  CHECK(nef::intersects(cube, set("halfspace(1,0,0,0)")));
  CHECK_FALSE(nef::intersects(cube, set("interior(halfspace(1,0,0,0))")));
  CHECK(nef::intersects(set("!box(0,0,0, 2,2,2)"), cube, {Rational(3, 2), Rational(0), Rational(0)}));
  const Polyhedron hollow = set("box(0,0,0, 9,9,9) - box(1,1,1, 8,8,8)");
  CHECK_FALSE(nef::intersects(hollow, cube, {Rational(4), Rational(4), Rational(4)}));
  CHECK_FALSE(nef::intersects(cube, hollow, {Rational(-4), Rational(-4), Rational(-4)}));
  CHECK_FALSE(nef::intersects(hollow, cube, {Rational(1), Rational(4), Rational(4)}));
  CHECK(nef::intersects(hollow, cube, {Rational(999, 1000), Rational(4), Rational(4)}));
  const Rational far(nef::Integer(1) << 80U);
  CHECK_FALSE(nef::intersects(cube, cube, {far, Rational(0), Rational(0)}));
  CHECK(nef::intersects(cube, set("box(0,0,0, 1,1,1)"), {Rational(1), Rational(1), Rational(1)}));
}

}  // namespace
