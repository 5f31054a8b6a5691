// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/scene/scene.h"

#include "nef/base/error.h"
#include "nef/construct/construct.h"

namespace nef::planner {

Polyhedron reachable_part(const Polyhedron& obstacle, const Scene& scene, const Monitor& monitor,
                          const std::string& name) {
  require_bounded_robot(scene);
  if (obstacle.is_bounded()) return obstacle;
  if (!scene.box) throw InputError(name + " is unbounded: give the scene a box");
  // No less than the distance of any point of the robot from its reference point.
  Rational reach = 1;
  const std::array<Rational3, 2> robot = *bounding_box(scene.robot);
  for (const Rational3& corner : robot) {
    for (const Rational& x : corner) reach += abs(x);
  }
  Rational3 low = (*scene.box)[0];
  Rational3 high = (*scene.box)[1];
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] -= reach;
    high[k] += reach;
  }
  return intersect(obstacle, make_box(low, high, monitor), monitor);
}

}  // namespace nef::planner
