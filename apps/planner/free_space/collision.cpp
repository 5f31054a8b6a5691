// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/collision.h"

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_space.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/number/brief_text.h"
#include "nef/query/location_name.h"

namespace nef::planner {
namespace {

// Any point of a set that is not empty, as far inside as its dimension allows.
Rational3 some_point(const Polyhedron& set, const Monitor& monitor) {
  const FreeSpace space(set);
  auto cell = static_cast<CellId>(space.cells().size());  // larger dimensions come later
  while (!space.is_free(--cell)) continue;
  return space.point_in(cell, monitor);
}

}  // namespace

std::optional<Collision> find_collision(const Scene& scene, const Rational3& position, const Monitor& monitor) {
  Collision collision;
  if (!is_in_box(position, scene.box)) {
    collision.outside_box = true;
    collision.point = position;
    return collision;
  }
  using minkowski::without_border;
  const Polyhedron robot = transform(scene.robot, AffineMap::translate(position), monitor);
  const bool allow = scene.contact == ContactRule::kAllow;
  // The points in which the robot must not meet obstacles. What is thin meets them without their borders only.
  const Polyhedron solid = allow ? interior(robot, monitor) : robot;
  const bool has_thin_parts = allow && !robot.is_regular();
  const Polyhedron inner = has_thin_parts ? without_border(robot) : Polyhedron();
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const Polyhedron& obstacle = scene.obstacles[i];
    Polyhedron overlap = intersect(solid, obstacle, monitor);
    if (overlap.is_empty() && has_thin_parts) overlap = intersect(inner, without_border(obstacle), monitor);
    if (overlap.is_empty()) continue;
    // The boundary of the obstacle says more than its inside.
    const Polyhedron surface = intersect(overlap, boundary(obstacle, monitor), monitor);
    collision.obstacle = i;
    collision.point = some_point(surface.is_empty() ? overlap : surface, monitor);
    collision.cell = locate(obstacle, collision.point);
    return collision;
  }
  if (!has_thin_parts) return std::nullopt;
  // Thin parts may also be caught in the seam between touching obstacles.
  const Polyhedron overlap = intersect(inner, without_border(unite_all(scene.obstacles, monitor)), monitor);
  if (overlap.is_empty()) return std::nullopt;
  collision.point = some_point(overlap, monitor);
  while (!contains(scene.obstacles[collision.obstacle], collision.point)) ++collision.obstacle;
  collision.cell = locate(scene.obstacles[collision.obstacle], collision.point);
  return collision;
}

std::string describe(const Collision& collision, const Scene& scene) {
  const std::string at = brief_text(collision.point);
  if (collision.outside_box) return "outside the box at " + at;
  return "overlaps obstacle " + std::to_string(collision.obstacle) + " (" +
         in_quotes(scene.obstacle_names[collision.obstacle]) + "), " + std::string(location_name(collision.cell.kind)) +
         " " + std::to_string(collision.cell.index) + ", at " + at;
}

}  // namespace nef::planner
