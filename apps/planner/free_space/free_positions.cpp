// SPDX-License-Identifier: Apache-2.0
//
// Where contact is allowed, free positions are the complement of the sum of obstacles and reflected robot, both without
// their borders (`configuration_space`). Where it is forbidden, they are the interior of that for closed solids, and
// the complement of the closed sum otherwise.
//
// An obstacle that comes or goes costs one sum and one Boolean operation with all of free space. For one that goes,
// what only it forbids is computed from the obstacles near it alone: those whose boxes are closer than the robot's
// extent.
#include "apps/planner/free_space/free_positions.h"

#include <cmath>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/part_of_sum.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/complex/item_boxes.h"

namespace nef::planner {
namespace {

bool all_regular(const Scene& scene, const std::vector<Polyhedron>& obstacles) {
  if (!scene.robot.is_regular()) return false;
  for (const Polyhedron& obstacle : obstacles) {
    if (!obstacle.is_regular()) return false;
  }
  return true;
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

// A box around a bounded set.
Box box_around(const Polyhedron& set) {
  Box box;
  const Complex& c = set.complex();
  for (const VertexId v : c.vertex_ids()) box.add(vertex_box(c, v));
  return box;
}

// The obstacles but one that may be met at positions at which that one is met: their boxes are less than the robot's
// extent apart.
std::vector<std::size_t> obstacles_near(const Scene& scene, std::size_t index) {
  std::vector<std::size_t> near;
  const bool all = !scene.obstacles[index].is_bounded();
  Box reach = all ? Box{} : box_around(scene.obstacles[index]);
  const Box robot = box_around(scene.robot);
  for (std::size_t k = 0; k < 3; ++k) {
    // A hair more than doubles round.
    const double extent = (robot.high[k] - robot.low[k]) * (1 + 0x1p-50);
    const double slack = 0x1p-50 * (std::fabs(reach.low[k]) + std::fabs(reach.high[k]) + extent);
    reach.low[k] -= extent + slack;
    reach.high[k] += extent + slack;
  }
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    if (i == index) continue;
    if (all || !scene.obstacles[i].is_bounded() || box_around(scene.obstacles[i]).overlaps(reach)) near.push_back(i);
  }
  return near;
}

}  // namespace

minkowski::FixedObstacles fixed_obstacles(const Scene& scene, const Monitor& monitor) {
  std::vector<Polyhedron> obstacles;
  for (const Polyhedron& obstacle : scene.obstacles) obstacles.push_back(reachable_part(obstacle, scene, monitor));
  return {obstacles, scene.box, scene.contact == ContactRule::kAllow, monitor};
}

Polyhedron free_positions(const Scene& scene, const Monitor& monitor) {
  require_no_rotation(scene);
  require_bounded_robot(scene);
  const minkowski::PartOfSum whole(monitor);  // tells of nothing but the sum
  const minkowski::MinkowskiOptions options{.monitor = whole.monitor()};
  const Monitor quiet = monitor.quiet();
  std::vector<Polyhedron> obstacles;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    obstacles.push_back(reachable_part(scene.obstacles[i], scene, quiet,
                                       "obstacle " + std::to_string(i) + " (" + scene.obstacle_names[i] + ")"));
  }
  if (scene.contact == ContactRule::kAllow) {
    return minkowski::configuration_space(scene.robot, obstacles, scene.box, options);
  }
  Polyhedron free;
  if (all_regular(scene, obstacles)) {
    // closure(int O + -int R) = O + -R for closures of interiors, so the complement of the closed
    // sum is the interior of the complement of the open one.
    free = interior(minkowski::configuration_space(scene.robot, obstacles, std::nullopt, options), quiet);
  } else {
    free = complement(
        minkowski::minkowski_sum(unite_all(obstacles, quiet), minkowski::negate(scene.robot, quiet), options));
  }
  return scene.box ? intersect(free, make_box((*scene.box)[0], (*scene.box)[1], quiet), quiet) : free;
}

void apply(const ObstacleChange& change, Scene& scene) {
  if (!change.index) {
    scene.obstacles.push_back(*change.obstacle);
    scene.obstacle_names.emplace_back("obstacle");
  } else if (change.obstacle) {
    scene.obstacles[*change.index] = *change.obstacle;
  } else {
    scene.obstacles.erase(scene.obstacles.begin() + static_cast<std::ptrdiff_t>(*change.index));
    scene.obstacle_names.erase(scene.obstacle_names.begin() + static_cast<std::ptrdiff_t>(*change.index));
  }
}

bool obstacles_are_independent(const Scene& scene) {
  return scene.contact == ContactRule::kForbid || scene.robot.is_regular();
}

// One operation with all of free space: what comes free is apart from it, what no longer is free a part of it.
Polyhedron free_positions_after(const ObstacleChange& change, const Scene& scene, const Polyhedron& free,
                                const Monitor& monitor) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const Monitor quiet = monitor.quiet();
  Polyhedron gained;  // what only the obstacle before forbids: free for those near it, not free for it
  if (change.index) {
    gained = subtract(free_positions(with_only(scene, obstacles_near(scene, *change.index)), monitor),
                      free_positions(with_only(scene, {*change.index}), monitor), quiet);
    if (!change.obstacle) return unite(free, gained, quiet);
  }
  Scene alone = with_only(scene, {});
  apply({std::nullopt, change.obstacle}, alone);
  const Polyhedron free_of_new = free_positions(alone, monitor);
  if (!change.index) return intersect(free, free_of_new, quiet);
  const Polyhedron lost = subtract(free, free_of_new, quiet);
  return symmetric_difference(free, unite(intersect(gained, free_of_new, quiet), lost, quiet), quiet);
}

}  // namespace nef::planner
