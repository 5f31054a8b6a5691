// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_robot.h"

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/rational_vectors.h"

namespace nef::planner {

TurningRobot::TurningRobot(const Polyhedron& robot, std::size_t axis) : robot_(robot), axis_(axis) {
  if (!robot.is_bounded() || robot.is_empty() || !robot.is_regular()) {
    throw InputError("a robot that turns must be a bounded solid without surfaces, curves or points sticking out");
  }
  for (const minkowski::ConvexCell& cell : minkowski::decompose(robot)) {
    if (cell.dimension < 3) continue;  // walls between solid cells
    Piece& piece = pieces_.emplace_back();
    piece.vertices = cell.mesh.vertices;
    for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
      const auto ring = cell.mesh.face(f);
      const Rational3& p = piece.vertices[ring[0]];
      const Rational3 normal = cross(minus(piece.vertices[ring[1]], p), minus(piece.vertices[ring[2]], p));
      piece.faces.push_back({normal, dot(normal, p)});
    }
  }
}

Polyhedron TurningRobot::outer(const Turn& a, const Turn& b) const {
  const AffineMap at_a = rotation_of(a, axis_);
  const AffineMap at_b = rotation_of(b, axis_);
  const Rational tangent = half_tangent_between(a, b);
  const std::size_t i = (axis_ + 1) % 3;
  const std::size_t j = (axis_ + 2) % 3;
  std::vector<Polyhedron> hulls;
  for (const Piece& piece : pieces_) {
    std::vector<Rational3> points;
    for (const Rational3& v : piece.vertices) {
      const Rational3 from = at_a(v);
      Rational3 corner = from;
      corner[i] -= tangent * from[j];
      corner[j] += tangent * from[i];
      points.push_back(from);
      points.push_back(corner);
      points.push_back(at_b(v));
    }
    hulls.push_back(convex_hull(points));
  }
  return unite_all(hulls);
}

Polyhedron TurningRobot::inner_of_piece(const Piece& piece, const Turn& a, const Turn& b) const {
  const AffineMap at_a = rotation_of(a, axis_);
  const AffineMap at_b = rotation_of(b, axis_);
  const Rational tangent = half_tangent_between(a, b);
  const Rational factor = 2 / (1 + tangent * tangent);  // 1 + cos(b - a)
  std::vector<Polyhedron> parts;
  for (const AffineMap& map : {at_a, at_b}) {
    std::vector<Rational3> points;
    for (const Rational3& v : piece.vertices) points.push_back(map(v));
    parts.push_back(convex_hull(points));
  }
  for (const Face& face : piece.faces) {
    const Rational3 from = at_a(face.normal);
    const Rational3 to = at_b(face.normal);
    Rational3 normal;
    for (std::size_t k = 0; k < 3; ++k) normal[k] = from[k] + to[k];
    normal[axis_] = factor * face.normal[axis_];
    if (is_zero(normal)) continue;
    parts.push_back(make_halfspace(normal[0], normal[1], normal[2], -factor * face.offset));
  }
  return intersect_all(parts);
}

Polyhedron TurningRobot::inner(const Turn& a, const Turn& b) const {
  std::vector<Polyhedron> parts;
  for (const Piece& piece : pieces_) parts.push_back(inner_of_piece(piece, a, b));
  return regularize(unite_all(parts));
}

std::vector<std::array<Rational, 2>> TurningRobot::normals() const {
  std::vector<std::array<Rational, 2>> result;
  for (const Piece& piece : pieces_) {
    for (const Face& face : piece.faces) {
      result.push_back({face.normal[(axis_ + 1) % 3], face.normal[(axis_ + 2) % 3]});
    }
  }
  return result;
}

}  // namespace nef::planner
