// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/clearance/widest.h"

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/number/brief_text.h"

namespace nef::planner {

Polyhedron around_ball(const Rational& radius, const Monitor& monitor) {
  // Half-spaces across the directions (1, 0, 0) and (2, 2, 1) / 3 in all orders and signs, which have rational lengths.
  std::vector<Polyhedron> sides{make_box({-radius, -radius, -radius}, {radius, radius, radius}, monitor)};
  for (std::size_t one = 0; one < 3; ++one) {
    for (int signs = 0; signs < 8; ++signs) {
      Rational3 n{2, 2, 2};
      n[one] = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        if ((signs >> k & 1) != 0) n[k] = -n[k];
      }
      sides.push_back(make_halfspace(n[0], n[1], n[2], -3 * radius, true, monitor));
    }
  }
  return intersect_all(sides, monitor);
}

void keep_clear(Scene& scene, const Rational& distance, const Monitor& monitor) {
  if (distance <= 0) throw InputError("--keep-clear: the distance must be positive");
  minkowski::MinkowskiOptions options;
  options.monitor = monitor;
  scene.robot = minkowski::minkowski_sum(scene.robot, around_ball(distance, monitor), options);
  scene.messages.push_back(
      "the robot is enlarged by a polyhedron around the ball of radius " + brief_text(distance) +
      ": paths keep at least this distance, and paths that keep less than 1.2 times as much may be missed");
}

}  // namespace nef::planner
