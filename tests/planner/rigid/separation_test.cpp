// SPDX-License-Identifier: Apache-2.0
//
// What doubles say of two polytopes that touch in a vertex, or nearly do: never apart if they touch, never overlapping
// if they do no more than that.
#include "apps/planner/rigid/separation.h"

#include <catch2/catch.hpp>

#include "nef/base/fast_path.h"
#include "tests/support/next_to_zero.h"

namespace nef::planner::test {

using nef::test::NextToZero;
using nef::test::TwoTetrahedra;

TEST_CASE("polytopes that touch in a vertex, or are a hair apart or into each other", "[bounds]") {
  NextToZero random(1);
  int apart = 0;
  int overlapping = 0;
  for (int i = 0; i < 1000; ++i) {
    const TwoTetrahedra two = vertex_on_facet(random);
    const RigidBody a = RigidBody::of_set(convex_hull(two.first));
    const RigidBody b = RigidBody::of_set(convex_hull(two.second));
    REQUIRE(a.pieces().size() == 1);
    REQUIRE(b.pieces().size() == 1);
    RoughPolytope rough_a;
    RoughPolytope rough_b;
    place(a.pieces()[0], rough_a);
    place(b.pieces()[0], rough_b);
    const Separation between = plane_between(rough_a, rough_b);
    const Separation inside = overlap(a.pieces()[0], rough_a, b.pieces()[0], 0);
    CAPTURE(i, two.shift);
    REQUIRE((between != Separation::kApart || two.shift > 0));
    REQUIRE((inside != Separation::kOverlapping || two.shift < 0));
    if (between == Separation::kApart) ++apart;
    if (inside == Separation::kOverlapping) ++overlapping;
  }
  CHECK(apart > 0);  // the test reaches both sides of the bound
  CHECK(overlapping > 0);
}

}  // namespace nef::planner::test
