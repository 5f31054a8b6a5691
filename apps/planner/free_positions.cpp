// SPDX-License-Identifier: Apache-2.0
//
// From a scene to the free positions of its robot, and from a forbidden position to its reason.
#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space.h"
#include "apps/planner/scene.h"
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

// Any point of a set that is not empty, as far inside as its dimension allows.
Rational3 some_point(const Polyhedron& set) {
  const FreeSpace space(set);
  CellId best = kNoCell;
  for (CellId cell = 0; cell < space.cells().size(); ++cell) {
    if (space.is_free(cell)) best = cell;  // larger dimensions come later
  }
  NEF_ASSERT(best != kNoCell);
  if (space.complex().vertex_count() == 0) return {};  // all of space
  return space.zones().interior_point(space.zones().zone_in(best));
}

bool in_box(const Scene& scene, const Rational3& position) {
  if (!scene.box) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (position[i] < (*scene.box)[0][i] || position[i] > (*scene.box)[1][i]) return false;
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

std::optional<Collision> find_collision(const Scene& scene, const Rational3& position) {
  Collision collision;
  if (!in_box(scene, position)) {
    collision.outside_box = true;
    collision.point = position;
    return collision;
  }
  const Polyhedron robot = transform(scene.robot, AffineMap::translate(position));
  const bool allow = scene.contact == ContactRule::kAllow;
  // The points in which the robot must not meet obstacles. Its parts that are no solid must not enter their insides.
  const Polyhedron solid = allow ? interior(robot) : robot;
  const bool has_thin_parts = allow && !robot.is_regular();
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const Polyhedron& obstacle = scene.obstacles[i];
    Polyhedron overlap = intersect(solid, obstacle);
    if (overlap.is_empty() && has_thin_parts) overlap = intersect(robot, interior(obstacle));
    if (overlap.is_empty()) continue;
    // The boundary of the obstacle says more than its inside.
    const Polyhedron surface = intersect(overlap, boundary(obstacle));
    collision.obstacle = i;
    collision.point = some_point(surface.is_empty() ? overlap : surface);
    collision.cell = locate(obstacle, collision.point);
    return collision;
  }
  if (!has_thin_parts) return std::nullopt;
  // Thin parts may also be caught in the seam between touching obstacles.
  const Polyhedron overlap = intersect(robot, interior(unite_all(scene.obstacles)));
  if (overlap.is_empty()) return std::nullopt;
  collision.point = some_point(overlap);
  while (!contains(scene.obstacles[collision.obstacle], collision.point)) ++collision.obstacle;
  collision.cell = locate(scene.obstacles[collision.obstacle], collision.point);
  return collision;
}

std::string describe(const Collision& collision, const Scene& scene) {
  static constexpr std::array<const char*, 4> kKinds{"vertex", "edge", "facet", "volume"};
  const std::string at = "(" + to_string(collision.point[0]) + ", " + to_string(collision.point[1]) + ", " +
                         to_string(collision.point[2]) + ")";
  if (collision.outside_box) return "outside the box at " + at;
  return "overlaps obstacle " + std::to_string(collision.obstacle) + " (" + scene.obstacle_names[collision.obstacle] +
         "), " + kKinds[static_cast<std::size_t>(collision.cell.kind)] + " " + std::to_string(collision.cell.index) +
         ", at " + at;
}

}  // namespace nef::planner
