// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/clipped_polytope.h"

#include <catch2/catch.hpp>
#include <random>

#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::planner::test {
namespace {

TEST_CASE("a convex solid cut by planes, through its vertices, edges and faces as well") {
  std::mt19937 random(5);
  const auto number = [&](int low, int high) {
    return Rational(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
  };
  for (int i = 0; i < 300; ++i) {
    // A grid as coarse as this makes planes through vertices ordinary.
    std::vector<Rational3> points;
    for (int k = 0; k < 6; ++k) points.push_back({number(-2, 2), number(-2, 2), number(-2, 2)});
    if (hull_of(points).dimension < 3) continue;
    std::optional<Mesh> rest = convex_hull_mesh(points);
    Polyhedron expected = convex_hull(points);
    for (int k = 0; k < 3; ++k) {
      const Rational3 normal{number(-1, 1), number(-1, 1), number(-1, 1)};
      if (is_zero(normal)) continue;
      const Rational offset = number(-2, 3);
      expected = regularize(intersect(expected, make_halfspace(normal[0], normal[1], normal[2], -offset)));
      if (rest) rest = clipped(std::move(*rest), normal, offset);
      REQUIRE(rest.has_value() == !expected.is_empty());
      if (!rest) break;
      const Polyhedron cut = from_mesh(*rest, MeshOptions{.strict = true});  // with all its checks
      REQUIRE(equal(cut, expected));
      REQUIRE(rest->face_count() == cut.complex().facets.size());
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
