// SPDX-License-Identifier: Apache-2.0
//
// For each pair of a robot's piece and an obstacle's, both swept over the motion: a separating plane is searched in
// doubles (rigid/separation.h). If it is found, the two are apart. If none comes close, a point inside both, by a
// margin, proves a collision. Otherwise the exact hull of differences decides. A motion that turns encloses the arc of
// each vertex by three corners, and is halved until every part is surely free or the depth is used up.
#include "apps/planner/turning/turning_collision.h"

#include <algorithm>
#include <cmath>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/hulls_apart.h"
#include "apps/planner/scene/reachable_part.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
TurningCollision::TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor)
    : robot_(scene.robot, axis, monitor), box_(scene.box), contact_(scene.contact) {
  for (const TurningRobot::Piece& piece : robot_.pieces()) {
    Shape& shape = shapes_.emplace_back();
    for (const Rational3& v : piece.mesh.vertices) {
      shape.points.push_back(to_vector(v));
      shape.reach = std::max(shape.reach, shape.points.back().lpNorm<1>());
    }
    for (const TurningRobot::Face& face : piece.faces) {
      if (!is_zero(face.normal)) shape.normals.push_back(direction_of(face.normal));
    }
  }
  for (const Polyhedron& obstacle : scene.obstacles) {
    const Polyhedron bounded = reachable_part(obstacle, scene, monitor);
    const bool solid_everywhere = bounded.is_regular();
    for (const minkowski::ConvexCell& cell : minkowski::decompose(closure(bounded, monitor), monitor)) {
      if (cell.dimension < 3 && solid_everywhere) continue;  // walls between solid cells
      Solid& solid = obstacles_.emplace_back();
      solid.vertices = cell.mesh.vertices;
      for (const Rational3& v : solid.vertices) {
        solid.rough.points.push_back(to_vector(v));
        solid.rough.reach = std::max(solid.rough.reach, solid.rough.points.back().lpNorm<Eigen::Infinity>());
      }
      for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
        std::vector<Rational3> corners;
        for (const std::uint32_t corner : cell.mesh.face(f)) corners.push_back(solid.vertices[corner]);
        solid.rough.normals.push_back(direction_of(normal_of(std::span<const Rational3>(corners))));
        if (cell.dimension < 3) solid.rough.normals.push_back(-solid.rough.normals.back());
      }
      solid.flat = cell.dimension < 3;
      measure(solid);
    }
  }
}

void TurningCollision::measure(Solid& solid) {
  solid.low = solid.high = solid.rough.points.front();
  for (const Vector3d& p : solid.rough.points) {
    solid.low = solid.low.cwiseMin(p);
    solid.high = solid.high.cwiseMax(p);
  }
}

Separation TurningCollision::separation(const Solid& a, const Solid& b) {
  const double error = plane_error(a.rough, b.rough);
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (a.high[k] + error < b.low[k] || b.high[k] + error < a.low[k]) return Separation::kApart;
  }
  return plane_between(a.rough, b.rough);
}

bool TurningCollision::surely_overlap(const Solid& a, const Solid& b) {
  return have_inner_point({a.rough.points, a.rough.normals}, {b.rough.points, b.rough.normals},
                          a.rough.reach + b.rough.reach, 2 * plane_error(a.rough, b.rough));
}

// At a pose, or at one of three on the way.
bool TurningCollision::surely_hits(std::size_t piece, const Swept& way, const Solid& obstacle) const {
  if (obstacle.flat) return false;
  for (const double t : {0.5, 0.25, 0.75}) {
    Swept at = way;
    at.moves = false;
    at.from.position += t * (way.to.position - way.from.position);
    if (surely_overlap(swept(piece, at), obstacle)) return true;
    if (!way.moves) return false;
  }
  return false;
}

bool TurningCollision::exactly_apart(const std::vector<Rational3>& a, const std::vector<Rational3>& b) const {
  return hulls_are_apart(a, b, contact_ == ContactRule::kForbid);
}

std::vector<Rational3> TurningCollision::exactly_swept(const TurningRobot::Piece& piece, const Pose& from,
                                                       const Pose& to) const {
  const AffineMap at_from = axis().rotation(from.turn);
  const AffineMap at_to = axis().rotation(to.turn);
  const Rational tangent = axis().half_tangent_between(from.turn, to.turn);
  std::vector<Rational3> result;
  for (const Rational3& v : piece.mesh.vertices) {
    std::vector<Rational3> arc{at_from(v)};
    if (from.turn != to.turn) {
      Rational3 corner = cross(axis().direction(), arc[0]);
      for (std::size_t k = 0; k < 3; ++k) corner[k] = arc[0][k] + tangent * corner[k];
      arc.push_back(corner);
      arc.push_back(at_to(v));
    }
    for (const Rational3& p : arc) {
      result.push_back({p[0] + from.position[0], p[1] + from.position[1], p[2] + from.position[2]});
      if (from.position == to.position) continue;
      result.push_back({p[0] + to.position[0], p[1] + to.position[1], p[2] + to.position[2]});
    }
  }
  return result;
}

TurningCollision::Swept TurningCollision::sweep(const Pose& from, const Pose& to) const {
  Swept swept;
  swept.turns = from.turn != to.turn;
  swept.moves = from.position != to.position;
  for (const auto& [pose, end] : {std::pair(&from, &swept.from), std::pair(&to, &swept.to)}) {
    const AffineMap map = axis().rotation(pose->turn);
    for (std::size_t i = 0; i < 3; ++i) end->rotation.row(static_cast<Eigen::Index>(i)) = to_vector(map.linear[i]);
    end->position = to_vector(pose->position);
    swept.position_reach = std::max(swept.position_reach, end->position.lpNorm<Eigen::Infinity>());
  }
  swept.tangent = nearest_double(axis().half_tangent_between(from.turn, to.turn));
  return swept;
}

// The images are off by less than kImageError of this reach. u = 2^-53, L the sum of a vertex's coordinates. A turned
// vertex p is off by u for the entries of the matrix, u for the vertex, and 3u for products and sums: 5u L. The corner
// of its arc adds t n x p, where t |n| is at most 1 and a little (a quarter turn) and |n|_1 below 1.8 |n|: off by 5u
// for p and 6u more for t, n, products and their difference, of 1.8 L. With the sums below 32u L in all, of 2.8 L and
// the position.
TurningCollision::Solid TurningCollision::swept(std::size_t piece, const Swept& sweep) const {
  const Shape& shape = shapes_[piece];
  Solid solid;
  solid.rough.reach = 4 * shape.reach + sweep.position_reach;
  const auto add = [&](const Vector3d& p) {
    solid.rough.points.push_back(p + sweep.from.position);
    if (sweep.moves) solid.rough.points.push_back(p + sweep.to.position);
  };
  const Vector3d n = to_vector(axis().direction());
  for (const Vector3d& v : shape.points) {
    const Vector3d p = sweep.from.rotation * v;
    add(p);
    if (!sweep.turns) continue;
    add(p + sweep.tangent * n.cross(p));
    add(sweep.to.rotation * v);
  }
  for (const Vector3d& normal : shape.normals) {
    solid.rough.normals.emplace_back(sweep.from.rotation * normal);
    if (sweep.turns) solid.rough.normals.emplace_back(sweep.to.rotation * normal);
  }
  measure(solid);
  return solid;
}

bool TurningCollision::is_free_at(const Turn& turn, const Rational3& from, const Rational3& to) const {
  if (!is_in_box(from, box_) || !is_in_box(to, box_)) return false;
  const Pose begin{from, turn};
  const Pose end{to, turn};
  const Swept way = sweep(begin, end);
  std::vector<const Solid*> touched;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const Solid solid = swept(i, way);
    for (const Solid& obstacle : obstacles_) {
      const Separation plane = separation(solid, obstacle);
      if (plane == Separation::kApart) continue;
      if (plane == Separation::kUnknown && surely_hits(i, way, obstacle)) return false;
      if (!exactly_apart(exactly_swept(robot_.pieces()[i], begin, end), obstacle.vertices)) return false;
      if (obstacle.flat) touched.push_back(&obstacle);
    }
  }
  // What is flat may lie where pieces of the robot meet, on the borders of these and inside the robot.
  if (robot_.pieces().size() == 1 || contact_ == ContactRule::kForbid) return true;
  return std::none_of(touched.begin(), touched.end(),
                      [&](const Solid* flat) { return meets_flat(*flat, turn, from, to); });
}

bool TurningCollision::meets_flat(const Solid& flat, const Turn& turn, const Rational3& from,
                                  const Rational3& to) const {
  const Polyhedron swept = minkowski::minkowski_sum(interior(robot_.at(turn)), make_segment(from, to));
  return !intersect(swept, convex_hull(flat.vertices)).is_empty();
}

bool TurningCollision::is_free(const Pose& pose) const { return is_free_at(pose.turn, pose.position, pose.position); }

bool TurningCollision::is_free(const Pose& from, const Pose& to, int depth) const {
  if (from.turn == to.turn) return is_free_at(from.turn, from.position, to.position);
  if (!is_free(to)) return false;
  const auto surely_free = [&] {
    if (!is_in_box(from.position, box_) || !is_in_box(to.position, box_)) return false;
    const Swept way = sweep(from, to);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const Solid solid = swept(i, way);
      for (const Solid& obstacle : obstacles_) {
        const Separation plane = separation(solid, obstacle);
        if (plane == Separation::kApart) continue;
        // What slides along a floor as it turns is free, too.
        const bool sure_contact = !obstacle.flat || robot_.pieces().size() == 1;
        if (plane == Separation::kUnknown || !sure_contact) return false;
        if (!exactly_apart(exactly_swept(robot_.pieces()[i], from, to), obstacle.vertices)) return false;
      }
    }
    return true;
  };
  // More than a quarter at once sweeps corners far out.
  if (abs(to.turn - from.turn) <= 1 && surely_free()) return true;
  if (depth == 0) return false;
  Pose middle = from;
  middle.position = point_between(from.position, to.position, Rational(1, 2));
  middle.turn = axis().turn_of_degrees(exact_rational((axis().degrees_of(from.turn) + axis().degrees_of(to.turn)) / 2));
  return is_free(from, middle, depth - 1) && is_free(middle, to, depth - 1);
}

}  // namespace nef::planner
