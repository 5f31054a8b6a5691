// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_robot.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

TEST_CASE("a robot reaches as far as the farthest corner of its box, which may be neither the lowest nor the highest") {
  CHECK(reach_of(make_box({-3, -1, -1}, {1, 1, 3})) == Approx(std::sqrt(19.0)));
  CHECK(reach_of(make_box({1, 2, -2}, {1, 2, -2})) == Approx(3));
}

Polyhedron united(const std::vector<Mesh>& pieces) {
  std::vector<Polyhedron> parts;
  for (const Mesh& piece : pieces) parts.push_back(convex_hull(piece.vertices));
  return unite_all(parts);
}

TEST_CASE("the outer robot holds the robot at all angles, which all hold the inner one") {
  std::mt19937 random(3);
  const Polyhedron robots[] = {make_box({-1, -2, 0}, {3, 1, 1}), make_box({1, 1, -1}, {3, 2, 1}),
                               unite(make_box({-1, -1, -1}, {4, 1, 1}), make_box({-1, -1, -1}, {1, 3, 1}))};
  for (const Polyhedron& robot : robots) {
    for (const Rational3& direction : turning_axes()) {
      const TurningRobot turning(robot, TurningAxis(direction));
      for (int i = 0; i < 2; ++i) {
        const long low = static_cast<long>(random() % 20);
        const Turn a = 1 + ratio(low, 32);
        const Turn b = a + ratio(1 + static_cast<long>(random() % 11), 32);
        const Polyhedron outer = united(turning.outer_pieces(a, b));
        const Polyhedron inner = united(turning.inner_pieces(a, b));
        CHECK(inner.is_regular());
        for (int k = 0; k <= 4; ++k) {
          const Polyhedron at = transform(robot, turning.axis().rotation(a + ratio(k, 4) * (b - a)));
          CHECK(subtract(at, outer).is_empty());
          CHECK(subtract(inner, at).is_empty());
        }
      }
    }
  }
  // Narrow ranges: nearly the robot itself.
  const TurningRobot bar(make_box({-3, -1, 0}, {3, 1, 1}), TurningAxis({0, 0, 1}));
  const Turn a = ratio(1, 3);
  const Turn b = a + ratio(1, 1000);
  CHECK(nearest_double(*volume(united(bar.inner_pieces(a, b)))) == Approx(12).epsilon(0.01));
  CHECK(nearest_double(*volume(united(bar.outer_pieces(a, b)))) == Approx(12).epsilon(0.01));
  const Polyhedron chords = intersect(make_halfspace(-1, 1, 0, -1), make_halfspace(1, -1, 0, -1));
  CHECK(equal(united(bar.inner_pieces(0, 1)), intersect(make_box({-1, -1, 0}, {1, 1, 1}), chords)));
  CHECK_THROWS_AS(TurningRobot(make_box({0, 0, 0}, {1, 1, 0}), TurningAxis({0, 0, 1})), InputError);
}

}  // namespace
}  // namespace nef::planner::test
