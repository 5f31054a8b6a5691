// SPDX-License-Identifier: Apache-2.0
//
// What doubles say of two polytopes that touch in a vertex, or nearly do: never apart if they touch, never overlapping
// if they do no more than that.
#include "apps/planner/rigid/separation.h"

#include <catch2/catch.hpp>
#include <random>

#include "nef/base/fast_path.h"
#include "tests/support/numbers/next_to_zero.h"

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

// Each triangle has an edge that runs by the other's, the rest on its side. No normal of a face separates them.
TEST_CASE("triangles that pass each other by their edges are apart, however large they are beside the gap") {
  std::mt19937 random(7);
  const auto number = [&] { return Rational(static_cast<long>(random() % 2001) - 1000); };
  const Rational gap(1, 1000);
  for (int i = 0; i < 500; ++i) {
    // Both edges meet the z axis, at 0 and at the gap; third corners are below and above.
    const Rational3 along_a{number(), number(), 0};
    const Rational3 along_b{number(), number(), 0};
    if (along_a[0] * along_b[1] == along_a[1] * along_b[0]) continue;
    const auto triangle = [&](const Rational3& along, const Rational& z, int side) {
      Mesh mesh;
      mesh.vertices = {{along[0], along[1], z}, {-along[0], -along[1], z}, {number(), number(), z + side * 50}};
      mesh.push_face(std::vector<std::uint32_t>{0, 1, 2});
      return RigidBody::of_surface(mesh);
    };
    const RigidBody a = triangle(along_a, 0, -1);
    const RigidBody b = triangle(along_b, gap, 1);
    RoughPolytope rough_a;
    RoughPolytope rough_b;
    place(a.pieces()[0], rough_a);
    place(b.pieces()[0], rough_b);
    CAPTURE(i);
    CHECK(plane_between(rough_a, rough_b) == Separation::kApart);
  }
}

}  // namespace nef::planner::test
