// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turn.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

TEST_CASE("turns about an axis: rational rotations by the angles that they say, in order") {
  for (const Rational3& direction : turning_axes()) {
    const TurningAxis axis(direction);
    const double length = std::sqrt(nearest_double(dot(direction, direction)));
    const Rational3 side = is_zero(cross(direction, Rational3{1, 0, 0})) ? Rational3{0, 1, 0} : Rational3{1, 0, 0};
    const Rational3 across = cross(direction, side);
    double before = -361;
    for (const int degrees : {-360, -350, -180, -91, -1, 0, 1, 17, 45, 89, 90, 91, 180, 200, 359, 360, 377}) {
      INFO(degrees);
      const Turn turn = axis.turn_of_degrees(degrees);
      CHECK(axis.degrees_of(turn) == Approx(degrees).margin(1e-8));
      CHECK(axis.degrees_of(turn) > before);
      before = axis.degrees_of(turn);
      const AffineMap rotation = axis.rotation(turn);
      CHECK(rotation.determinant() == 1);
      CHECK(rotation(direction) == direction);
      const Rational3 image = rotation(across);
      const Rational square = dot(across, across);
      CHECK(dot(image, image) == square);
      const double radians = degrees * M_PI / 180;
      CHECK(nearest_double(dot(image, across) / square) == Approx(std::cos(radians)).margin(1e-9));
      CHECK(nearest_double(dot(direction, cross(across, image)) / square) / length ==
            Approx(std::sin(radians)).margin(1e-9));
      // The quaternion, by the formula for its matrix.
      const auto [w, x, y, z] = axis.quaternion(turn);
      const Rational norm = w * w + x * x + y * y + z * z;
      CHECK(rotation.linear[0][0] == (w * w + x * x - y * y - z * z) / norm);
      CHECK(rotation.linear[1][0] == 2 * (x * y + w * z) / norm);
      CHECK(rotation.linear[2][1] == 2 * (y * z + w * x) / norm);
    }
    CHECK(axis.rotation(2)(across) == scaled_by(-1, across));
    CHECK(axis.rotation(4)(across) == across);
    const Turn a = axis.turn_of_degrees(80);
    const Turn b = axis.turn_of_degrees(105);
    // Where the tangents at both ends of an arc meet.
    const Rational3 corner = axis.between(a, b)(across);
    for (const Turn& end : {a, b}) {
      const Rational3 arm = axis.rotation(end)(across);
      const Rational3 tangent{corner[0] - arm[0], corner[1] - arm[1], corner[2] - arm[2]};
      CHECK(dot(tangent, arm) == 0);
      CHECK(std::sqrt(nearest_double(dot(tangent, tangent) / dot(arm, arm))) == Approx(std::tan(12.5 * M_PI / 180)));
    }
    for (const int degrees : {0, 17, 100, 180, 181, 300}) {
      const Turn turn = axis.turn_of_degrees(degrees);
      const Rational3 tilted = {across[0] + direction[0], across[1] + direction[1], across[2] + direction[2]};
      CHECK(axis.turn_between(tilted, scaled_by(3, axis.rotation(turn)(tilted))) == turn);
    }
    CHECK_FALSE(axis.turn_between(across, direction).has_value());
  }
  const TurningAxis z({0, 0, 1});
  CHECK(z.turn_of_degrees(90) == 1);
  CHECK(z.turn_of_degrees(-90) == -1);
  CHECK(z.turn_between({1, 0, 0}, {-3, 4, 0}) == Turn(1) + ratio(1, 3));
  CHECK_FALSE(z.turn_between({1, 0, 0}, {1, 1, 0}).has_value());
  CHECK(z.between(ratio(5, 4), 2)({-1, 0, 0}) == Rational3{1, ratio(-3, 5), 0});
  CHECK_THROWS_AS(TurningAxis({0, 0, 0}), InputError);
}

}  // namespace
}  // namespace nef::planner::test
