// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/position_bounds.h"

#include <algorithm>
#include <cmath>

#include "apps/planner/turning/turning_robot.h"
#include "nef/polyhedron.h"

namespace nef::planner {

ompl::base::RealVectorBounds position_bounds(const Scene& scene) {
  std::optional<std::array<Rational3, 2>> box = scene.box;
  const double margin = box ? 0 : 2 * reach_of(scene.robot) + 1;
  if (!box) {
    const auto take = [&box](const Rational3& point) {
      if (!box) box = {point, point};
      for (std::size_t k = 0; k < 3; ++k) {
        (*box)[0][k] = std::min((*box)[0][k], point[k]);
        (*box)[1][k] = std::max((*box)[1][k], point[k]);
      }
    };
    for (const std::optional<Rational3>& end : {scene.start, scene.goal}) {
      if (end) take(*end);
    }
    for (const Polyhedron& obstacle : scene.obstacles) {
      if (const auto bounds = bounding_box(obstacle)) {
        for (const Rational3& corner : *bounds) take(corner);
      }
    }
    if (!box) take({});
  }
  ompl::base::RealVectorBounds result(3);
  for (unsigned k = 0; k < 3; ++k) {
    result.setLow(k, std::nextafter(nearest_double((*box)[0][k]) - margin, -HUGE_VAL));
    result.setHigh(k, std::nextafter(nearest_double((*box)[1][k]) + margin, HUGE_VAL));
  }
  return result;
}

}  // namespace nef::planner
