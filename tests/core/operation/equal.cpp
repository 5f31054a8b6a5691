// SPDX-License-Identifier: Apache-2.0
//
// Sets are compared by their vertices in canonical order.
#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/ball.h"

namespace nef::test {
namespace {

TEST_CASE("Sets that differ in one point, one mark or very little are not equal") {
  const Polyhedron box = set("box(0,0,0, 2,2,2)");
  CHECK(equal(box, set("box(0,0,0, 1,2,2) + box(1,0,0, 2,2,2)")));
  CHECK_FALSE(equal(box, set("interior(box(0,0,0, 2,2,2))")));
  CHECK_FALSE(equal(box, set("box(0,0,0, 2,2,2) - point(1,1,1)")));
  CHECK_FALSE(equal(box, set("box(0,0,0, 2,2,2) - polygon(0,0,0, 2,0,0, 2,2,0, 0,2,0)")));
  CHECK_FALSE(equal(box, transform(box, AffineMap::translate({Rational("1/1000000000000000000000000000000"), 0, 0}))));
  CHECK_FALSE(equal(set("segment(0,0,0, 1,0,0)"), set("segment(0,0,0, 0,1,0)")));
  CHECK(equal(set("segment(0,0,0, 1,0,0) + segment(1,0,0, 3,0,0)"), set("segment(3,0,0, 0,0,0)")));
}

TEST_CASE("Unbounded sets are equal whatever they were cut from") {
  CHECK(equal(set("everything"), complement(set("nothing"))));
  CHECK_FALSE(equal(set("everything"), set("nothing")));
  CHECK(equal(set("halfspace(1,2,3,4) + !halfspace(1,2,3,4)"), set("everything")));
  CHECK(equal(set("halfspace(1,2,3,4) * box(0,0,0, 1,1,1) - halfspace(1,2,3,4)"), set("nothing")));
  CHECK(equal(complement(set("box(0,0,0, 1,1,1)")), set("everything - box(0,0,0, 1,1,1)")));
  CHECK_FALSE(equal(set("halfspace(0,0,1,0)"), set("halfspace(0,0,-1,0)")));
  CHECK_FALSE(equal(set("halfspace(0,0,1,0)"), set("interior(halfspace(0,0,1,0))")));
}

TEST_CASE("Marks count, not only which points are in a set") {
  const Polyhedron box = set("box(0,0,0, 2,2,2)");
  const auto sum = [](LabelId x, LabelId y) { return static_cast<LabelId>(x + y); };
  const Polyhedron twice = overlay(box, set("box(0,0,0, 1,1,1)"), sum);
  CHECK(equal(twice, overlay(set("box(0,0,0, 1,1,1)"), box, sum)));
  CHECK_FALSE(equal(twice, overlay(box, set("box(1,1,1, 2,2,2)"), sum)));
  CHECK_FALSE(equal(overlay(box, box, sum), box));
}

TEST_CASE("To compare two sets of many vertices, next to nothing is asked of their planes") {
  const Polyhedron a = ball(2, 40, 20);
  const Polyhedron b = unite(intersect(a, set("halfspace(1,2,3,0)")), intersect(a, set("halfspace(-1,-2,-3,0)")));
  PredicateCounts counts;
  CHECK(equal(a, b, Monitor().counting(counts)));
  CHECK(counts.identity + counts.filter + counts.exact < a.complex().vertex_count());
}

}  // namespace
}  // namespace nef::test
