// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_robot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/turning/clipped_polytope.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

Mesh turned(Mesh mesh, const AffineMap& rotation) {
  for (Rational3& v : mesh.vertices) v = rotation(v);
  return mesh;
}

Polyhedron united(const std::vector<Mesh>& pieces, const Monitor& monitor) {
  std::vector<Polyhedron> parts;
  for (const Mesh& piece : pieces) parts.push_back(convex_hull(piece.vertices, monitor));
  return unite_all(parts, monitor);
}

std::optional<Mesh> inner_of_piece(const TurningRobot::Piece& piece, const TurningAxis& axis, const Turn& a,
                                   const Turn& b) {
  const AffineMap at_a = axis.rotation(a);
  const AffineMap at_b = axis.rotation(b);
  const Rational tangent = axis.half_tangent_between(a, b);
  const Rational factor = 2 / (1 + axis.square() * tangent * tangent);  // 1 + cos(b - a)
  std::optional<Mesh> rest = turned(piece.mesh, at_a);
  for (const TurningRobot::Face& face : piece.faces) {
    if (rest) rest = clipped(std::move(*rest), at_b(face.normal), face.offset);
  }
  for (const TurningRobot::Face& face : piece.faces) {
    const Rational3 from = at_a(face.normal);
    const Rational3 to = at_b(face.normal);
    const Rational along = dot(face.normal, axis.direction()) / axis.square();
    Rational3 normal;
    for (std::size_t k = 0; k < 3; ++k) normal[k] = from[k] + to[k] + (factor - 2) * along * axis.direction()[k];
    if (rest) rest = clipped(std::move(*rest), normal, factor * face.offset);
  }
  return rest;
}

}  // namespace

void require_turning_robot(const Polyhedron& robot) {
  if (!robot.is_bounded() || robot.is_empty() || !robot.is_regular()) {
    throw InputError("a robot that turns must be a bounded solid without surfaces, curves or points sticking out");
  }
}

double reach_of(const Polyhedron& robot) {
  double sum = 0;
  const std::array<Rational3, 2> box = *bounding_box(robot);
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::max(std::fabs(nearest_double(box[0][k])), std::fabs(nearest_double(box[1][k])));
    sum += x * x;
  }
  return std::sqrt(sum);
}

TurningRobot::TurningRobot(const Polyhedron& robot, const TurningAxis& axis, const Monitor& monitor)
    : robot_(robot), axis_(axis) {
  require_turning_robot(robot);
  for (minkowski::ConvexCell& cell : minkowski::decompose(robot, monitor)) {
    if (cell.dimension < 3) continue;  // walls between solid cells
    Piece& piece = pieces_.emplace_back();
    piece.mesh = std::move(cell.mesh);
    for (std::size_t f = 0; f < piece.mesh.face_count(); ++f) {
      const auto ring = piece.mesh.face(f);
      const std::vector<Rational3>& points = piece.mesh.vertices;
      const Rational3& p = points[ring[0]];
      const Rational3 normal = cross(minus(points[ring[1]], p), minus(points[ring[2]], p));
      piece.faces.push_back({normal, dot(normal, p)});
    }
  }
}

std::vector<Mesh> TurningRobot::pieces_at(const Turn& turn) const {
  const AffineMap rotation = axis_.rotation(turn);
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) result.push_back(turned(piece.mesh, rotation));
  return result;
}

std::vector<Mesh> TurningRobot::outer_pieces(const Turn& a, const Turn& b, const Monitor& monitor) const {
  const AffineMap at_a = axis_.rotation(a);
  const AffineMap at_b = axis_.rotation(b);
  const Rational tangent = axis_.half_tangent_between(a, b);
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) {
    std::vector<Rational3> points;
    for (const Rational3& v : piece.mesh.vertices) {
      const Rational3 from = at_a(v);
      Rational3 corner = cross(axis_.direction(), from);
      for (std::size_t k = 0; k < 3; ++k) corner[k] = from[k] + tangent * corner[k];
      points.push_back(from);
      points.push_back(corner);
      points.push_back(at_b(v));
    }
    result.push_back(convex_hull_mesh(points, monitor));
  }
  return result;
}

Polyhedron TurningRobot::outer(const Turn& a, const Turn& b, const Monitor& monitor) const {
  return united(outer_pieces(a, b, monitor), monitor);
}

std::vector<Mesh> TurningRobot::inner_pieces(const Turn& a, const Turn& b) const {
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) {
    if (std::optional<Mesh> inner = inner_of_piece(piece, axis_, a, b)) result.push_back(std::move(*inner));
  }
  return result;
}

Polyhedron TurningRobot::inner(const Turn& a, const Turn& b, const Monitor& monitor) const {
  return united(inner_pieces(a, b), monitor);
}

}  // namespace nef::planner
