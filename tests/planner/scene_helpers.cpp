// SPDX-License-Identifier: Apache-2.0
#include "tests/planner/scene_helpers.h"

#include <algorithm>
#include <cstdlib>

#include "apps/minkowski/minkowski.h"

namespace nef::planner::test {

Scene mapped(const Scene& scene, const AffineMap& map) {
  Scene result = scene;
  AffineMap linear = map;
  linear.translation = {};
  result.robot = transform(scene.robot, linear);
  for (Polyhedron& obstacle : result.obstacles) obstacle = transform(obstacle, map);
  if (result.start) result.start = map(*result.start);
  if (result.goal) result.goal = map(*result.goal);
  return result;
}

std::vector<int> component_dimensions(const FreeSpace& free) {
  std::vector<int> result;
  for (const Component& component : free.components()) result.push_back(component.dimension);
  std::sort(result.rbegin(), result.rend());
  return result;
}

std::string independent_complaint(const Scene& scene, const Polyhedron& free, const ExactPath& path, bool sweep) {
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const Polyhedron segment = make_segment(path.points[i], path.points[i + 1]);
    if (!subtract(segment, free).is_empty()) return "segment " + std::to_string(i) + " leaves free space";
    if (!sweep) continue;
    // An open robot swept along a closed segment is open; with contact allowed it must miss the obstacles.
    const Polyhedron swept = minkowski::minkowski_sum(interior(scene.robot), segment);
    for (const Polyhedron& obstacle : scene.obstacles) {
      if (!intersect(swept, obstacle).is_empty()) return "the robot hits an obstacle on segment " + std::to_string(i);
    }
  }
  return {};
}

unsigned seeds(unsigned few) {
  const char* text = std::getenv("PLANNER_SEEDS");
  return text == nullptr ? few : few * static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

}  // namespace nef::planner::test
