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
#include "apps/planner/scene/reachable_part.h"
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

minkowski::MinkowskiOptions minkowski_options(const BuildOptions& build, const Monitor& monitor) {
  minkowski::MinkowskiOptions options;
  options.progress = [&build](std::size_t done, std::size_t total) {
    if (build.progress) build.progress("configuration space", done, total);
    return true;
  };
  options.monitor = monitor;
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

// Asks nobody but the monitor whether to stop.
Polyhedron watched_positions(const Scene& scene, const BuildOptions& build, const Monitor& monitor) {
  require_no_rotation(scene);
  std::vector<Polyhedron> obstacles;
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    obstacles.push_back(reachable_part(scene.obstacles[i], scene, monitor,
                                       "obstacle " + std::to_string(i) + " (" + scene.obstacle_names[i] + ")"));
  }
  const minkowski::MinkowskiOptions options = minkowski_options(build, monitor);
  if (scene.contact == ContactRule::kAllow) {
    return minkowski::configuration_space(scene.robot, obstacles, scene.box, options);
  }
  Polyhedron free;
  if (all_regular(scene, obstacles)) {
    // closure(int O + -int R) = O + -R for closures of interiors, so the complement of the closed
    // sum is the interior of the complement of the open one.
    free = interior(minkowski::configuration_space(scene.robot, obstacles, std::nullopt, options), monitor);
  } else {
    free = complement(
        minkowski::minkowski_sum(unite_all(obstacles, monitor), minkowski::negate(scene.robot, monitor), options));
  }
  return scene.box ? intersect(free, make_box((*scene.box)[0], (*scene.box)[1], monitor), monitor) : free;
}

// What only one obstacle forbids: free for those near it, not free for it; others do not matter there.
Polyhedron forbidden_by_one(const Scene& scene, std::size_t index, const BuildOptions& options,
                            const Monitor& monitor) {
  return subtract(watched_positions(with_only(scene, obstacles_near(scene, index)), options, monitor),
                  watched_positions(with_only(scene, {index}), options, monitor), monitor);
}

Polyhedron free_of_one(const Scene& scene, const Polyhedron& obstacle, const BuildOptions& options,
                       const Monitor& monitor) {
  Scene alone = with_only(scene, {});
  alone.obstacles.push_back(obstacle);
  alone.obstacle_names.emplace_back("new");
  return watched_positions(alone, options, monitor);
}

}  // namespace

bool obstacles_are_independent(const Scene& scene) {
  return scene.contact == ContactRule::kForbid || scene.robot.is_regular();
}

Polyhedron with_obstacle(const Scene& scene, const Polyhedron& free, const Polyhedron& obstacle,
                         const BuildOptions& options) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const StopQuestion question(options.stop, options.monitor);
  return intersect(free, free_of_one(scene, obstacle, options, question.monitor()), question.monitor());
}

Polyhedron without_obstacle(const Scene& scene, const Polyhedron& free, std::size_t index,
                            const BuildOptions& options) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const StopQuestion question(options.stop, options.monitor);
  return unite(free, forbidden_by_one(scene, index, options, question.monitor()), question.monitor());
}

// One operation with all of free space: what comes free is apart from it, what no longer is free a part of it.
Polyhedron with_obstacle_moved(const Scene& scene, const Polyhedron& free, std::size_t index, const Polyhedron& moved,
                               const BuildOptions& options) {
  NEF_ASSERT(obstacles_are_independent(scene));
  const StopQuestion question(options.stop, options.monitor);
  const Monitor& monitor = question.monitor();
  const Polyhedron free_of_moved = free_of_one(scene, moved, options, monitor);
  const Polyhedron gained = intersect(forbidden_by_one(scene, index, options, monitor), free_of_moved, monitor);
  const Polyhedron lost = subtract(free, free_of_moved, monitor);
  return symmetric_difference(free, unite(gained, lost, monitor), monitor);
}

Polyhedron free_positions(const Scene& scene, const BuildOptions& build) {
  const StopQuestion question(build.stop, build.monitor);
  return watched_positions(scene, build, question.monitor());
}

}  // namespace nef::planner
