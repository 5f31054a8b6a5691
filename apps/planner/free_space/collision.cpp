// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/collision.h"

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_space.h"
#include "nef/base/error.h"
#include "nef/base/in_quotes.h"
#include "nef/number/brief_text.h"

namespace nef::planner {
namespace {

// Any point of a set that is not empty, as far inside as its dimension allows.
Rational3 some_point(const Polyhedron& set, const Monitor& monitor) {
  const FreeSpace space(set);
  CellId best = kNoCell;
  for (CellId cell = 0; cell < space.cells().size(); ++cell) {
    if (space.is_free(cell)) best = cell;  // larger dimensions come later
  }
  NEF_ASSERT(best != kNoCell);
  if (space.complex().vertex_count() == 0) return {};  // all of space
  space.build_roadmap(monitor);
  return space.zones().interior_point(space.zones().zone_in(best));
}

bool in_box(const Scene& scene, const Rational3& position) {
  if (!scene.box) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (position[i] < (*scene.box)[0][i] || position[i] > (*scene.box)[1][i]) return false;
  }
  return true;
}

}  // namespace

std::optional<Collision> find_collision(const Scene& scene, const Rational3& position, const Monitor& monitor) {
  Collision collision;
  if (!in_box(scene, position)) {
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
    Polyhedron overlap = intersect(solid, obstacle, 1, monitor);
    if (overlap.is_empty() && has_thin_parts) overlap = intersect(inner, without_border(obstacle), 1, monitor);
    if (overlap.is_empty()) continue;
    // The boundary of the obstacle says more than its inside.
    const Polyhedron surface = intersect(overlap, boundary(obstacle, monitor), 1, monitor);
    collision.obstacle = i;
    collision.point = some_point(surface.is_empty() ? overlap : surface, monitor);
    collision.cell = locate(obstacle, collision.point);
    return collision;
  }
  if (!has_thin_parts) return std::nullopt;
  // Thin parts may also be caught in the seam between touching obstacles.
  const Polyhedron overlap = intersect(inner, without_border(unite_all(scene.obstacles, 1, monitor)), 1, monitor);
  if (overlap.is_empty()) return std::nullopt;
  collision.point = some_point(overlap, monitor);
  while (!contains(scene.obstacles[collision.obstacle], collision.point)) ++collision.obstacle;
  collision.cell = locate(scene.obstacles[collision.obstacle], collision.point);
  return collision;
}

std::string describe(const Collision& collision, const Scene& scene) {
  static constexpr std::array<const char*, 4> kKinds{"vertex", "edge", "facet", "volume"};
  const std::string at = brief_text(collision.point);
  if (collision.outside_box) return "outside the box at " + at;
  return "overlaps obstacle " + std::to_string(collision.obstacle) + " (" +
         in_quotes(scene.obstacle_names[collision.obstacle]) + "), " +
         kKinds[static_cast<std::size_t>(collision.cell.kind)] + " " + std::to_string(collision.cell.index) + ", at " +
         at;
}

}  // namespace nef::planner
