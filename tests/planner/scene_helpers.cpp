// SPDX-License-Identifier: Apache-2.0
#include "tests/planner/scene_helpers.h"

#include <algorithm>
#include <cstdlib>

#include "apps/minkowski/minkowski.h"
#include "nef/construct/construct.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {

const std::vector<Rational3>& turning_axes() {
  static const std::vector<Rational3> result{{1, 0, 0}, {0, 1, 0},  {0, 0, 3}, {1, 2, 2},
                                             {1, 1, 1}, {-2, 3, 0}, {0, 1, -7}};
  return result;
}

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
  return nef::test::fewer(text == nullptr ? few : few * static_cast<unsigned>(std::strtoul(text, nullptr, 10)));
}

Rational small_number(std::mt19937& random, int low, int high, int denominator) {
  Rational value(std::uniform_int_distribution<int>(low * denominator, high * denominator)(random), denominator);
  value.canonicalize();
  return value;
}

Rational3 point_near_degenerate_set(std::mt19937& random, int denominator) {
  return {small_number(random, -1, 7, denominator), small_number(random, -1, 7, denominator),
          small_number(random, -1, 7, denominator)};
}

Polyhedron degenerate_set(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Polyhedron> parts;
  for (int i = 0; i < 6; ++i) {
    const Rational3 low = point_near_degenerate_set(random, 1);
    Rational3 high = low;
    for (Rational& x : high) x += small_number(random, 0, 3, 1);
    parts.push_back(make_box(low, high));
  }
  Polyhedron set = complement(unite_all(parts));
  switch (seed % 3) {
    case 0:
      return set;
    case 1:
      return unite(closure(set),
                   make_segment(point_near_degenerate_set(random, 1), point_near_degenerate_set(random, 2)));
    default: {
      AffineMap shear = AffineMap::identity();
      shear.linear[0][1] = Rational(1, 2);
      shear.linear[1][2] = Rational(-1, 3);
      return transform(set, shear);
    }
  }
}

}  // namespace nef::planner::test
