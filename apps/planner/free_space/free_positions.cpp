// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/free_positions.h"

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"

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
    return true;
  };
  return options;
}

// The scene with some of its obstacles only.
Scene with_only(const Scene& scene, const std::vector<std::size_t>& kept) {
  Scene result = scene;
  result.obstacles.clear();
  result.obstacle_names.clear();
  for (const std::size_t i : kept) {
    result.obstacles.push_back(scene.obstacles[i]);
    result.obstacle_names.push_back(scene.obstacle_names[i]);
  }
  return result;
}

// True if robots that meet one obstacle can meet the other one at the same position: the boxes of the two are less than
// the robot's extent apart.
bool may_forbid_the_same(const Scene& scene, const Polyhedron& a, const Polyhedron& b) {
  if (!a.is_bounded() || !b.is_bounded()) return true;
  const auto box_a = bounding_box(a);
  const auto box_b = bounding_box(b);
  if (!box_a || !box_b) return false;
  const std::array<Rational3, 2> robot = *bounding_box(scene.robot);
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational extent = robot[1][i] - robot[0][i];
    if ((*box_a)[0][i] - extent > (*box_b)[1][i] || (*box_b)[0][i] - extent > (*box_a)[1][i]) return false;
  }
  return true;
}

}  // namespace

bool obstacles_are_independent(const Scene& scene) {
  return scene.contact == ContactRule::kForbid || scene.robot.is_regular();
}

Polyhedron with_obstacle(const Scene& scene, const Polyhedron& free, const Polyhedron& obstacle,
                         const BuildOptions& options) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const Interruptible interruptible(options.stop);
  Scene alone = with_only(scene, {});
  alone.obstacles.push_back(obstacle);
  alone.obstacle_names.emplace_back("new");
  return intersect(free, free_positions(alone, options));
}

Polyhedron without_obstacle(const Scene& scene, const Polyhedron& free, std::size_t index,
                            const BuildOptions& options) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const Interruptible interruptible(options.stop);
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    if (i != index && may_forbid_the_same(scene, scene.obstacles[index], scene.obstacles[i])) near.push_back(i);
  }
  // What only this one forbids: free for those near, not free for it; others do not matter there.
  const Polyhedron freed =
      subtract(free_positions(with_only(scene, near), options), free_positions(with_only(scene, {index}), options));
  return unite(free, freed);
}

Polyhedron free_positions(const Scene& scene, const BuildOptions& build) {
  const Interruptible interruptible(build.stop);
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
