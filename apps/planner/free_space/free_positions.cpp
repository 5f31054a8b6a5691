// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/free_positions.h"

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

// An unbounded obstacle, cut to what a robot in the box can reach, with a margin so that the cuts
// stay away from it.
Polyhedron bounded_obstacle(const Polyhedron& obstacle, const Scene& scene, std::size_t index) {
  if (obstacle.is_bounded()) return obstacle;
  if (!scene.box) {
    throw InputError("obstacle " + std::to_string(index) + " (" + scene.obstacle_names[index] +
                     ") is unbounded: give the scene a box");
  }
  const std::array<Rational3, 2> robot = *bounding_box(scene.robot);
  Rational3 low = (*scene.box)[0];
  Rational3 high = (*scene.box)[1];
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] += robot[0][i] - 1;
    high[i] += robot[1][i] + 1;
  }
  return intersect(obstacle, make_box(low, high));
}

bool all_regular(const Scene& scene, const std::vector<Polyhedron>& obstacles) {
  if (!scene.robot.is_regular()) return false;
  for (const Polyhedron& obstacle : obstacles) {
    if (!obstacle.is_regular()) return false;
  }
  return true;
}

minkowski::MinkowskiOptions minkowski_options(const BuildOptions& build) {
  minkowski::MinkowskiOptions options;
  options.threads = build.threads;
  options.progress = [&build](std::size_t done, std::size_t total) {
    if (build.progress) build.progress("configuration space", done, total);
    return !build.stop || !build.stop();
  };
  return options;
}

}  // namespace

Polyhedron free_positions(const Scene& scene, const BuildOptions& build) {
  std::vector<Polyhedron> obstacles;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    obstacles.push_back(bounded_obstacle(scene.obstacles[i], scene, i));
  }
  const minkowski::MinkowskiOptions options = minkowski_options(build);
  if (scene.contact == ContactRule::kAllow) {
    return minkowski::configuration_space(scene.robot, obstacles, scene.box, options);
  }
  Polyhedron free;
  if (all_regular(scene, obstacles)) {
    // closure(int O + -int R) = O + -R for closures of interiors, so the complement of the closed
    // sum is the interior of the complement of the open one.
    free = interior(minkowski::configuration_space(scene.robot, obstacles, std::nullopt, options));
  } else {
    free = complement(
        minkowski::minkowski_sum(unite_all(obstacles, build.threads), minkowski::negate(scene.robot), options));
  }
  return scene.box ? intersect(free, make_box((*scene.box)[0], (*scene.box)[1])) : free;
}

}  // namespace nef::planner
