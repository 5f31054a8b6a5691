// SPDX-License-Identifier: Apache-2.0
//
// Many points at once against membership by the recipe.
#include "nef/query/locate_many.h"

#include <limits>

#include "nef/base/error.h"
#include "tests/laws/laws.h"

namespace nef {

TEST_CASE("many points are located as one by one") {
  test::for_all("locate_many", 4, [](const test::Recipe& recipe) {
    const Polyhedron whole = recipe.make();
    std::vector<std::array<double, 3>> points;
    const int count = *rc::gen::inRange(1, 400);
    for (int i = 0; i < count; ++i) {
      std::array<double, 3> p{};
      for (double& x : p) x = *rc::gen::inRange(-8, 32) / 8.0;
      if (i % 50 == 49) p[static_cast<std::size_t>(i / 50) % 3] = 1e300;
      points.push_back(p);
    }
    const std::vector<LabelId> marks = locate_many(whole, points, Monitor().on_threads(2));
    RC_ASSERT(marks.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      RC_ASSERT((marks[i] != 0) ==
                recipe.contains({Rational(points[i][0]), Rational(points[i][1]), Rational(points[i][2])}));
    }
  });
}

TEST_CASE("many points about a slanted solid") {
  const AffineMap turn = AffineMap::rotate({1, 2, 3}, 33);
  const Polyhedron solid = transform(test::set("box(0,0,0,1,2,3) - interior(box(0,0,0,1,1,1))"), turn);
  std::vector<std::array<double, 3>> points;
  for (int z = 0; z < 20; ++z) {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) points.push_back({x / 4.0 - 2.5, y / 4.0 - 2.5, z / 4.0 - 1});
    }
  }
  const std::vector<LabelId> marks = locate_many(solid, points);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational3 p{Rational(points[i][0]), Rational(points[i][1]), Rational(points[i][2])};
    // Back to where the solid is a box: the inverse of an orthogonal map is its transpose.
    Rational3 q;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = 0; k < 3; ++k) q[r] += turn.linear[k][r] * p[k];
    }
    bool in = q[0] >= 0 && q[1] >= 0 && q[2] >= 0 && q[0] <= 1 && q[1] <= 2 && q[2] <= 3;
    if (q[0] > 0 && q[1] > 0 && q[2] > 0 && q[0] < 1 && q[1] < 1 && q[2] < 1) in = false;
    if (in != (marks[i] != 0)) FAIL("point " << i);
    inside += in ? 1 : 0;
  }
  CHECK(inside > 100);
  CHECK(locate_many(Polyhedron::everything(), points) == std::vector<LabelId>(points.size(), 1));
  CHECK(locate_many(solid, {}).empty());
  points[7][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(locate_many(solid, points), InputError);
}

}  // namespace nef
