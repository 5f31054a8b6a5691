// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_robot.h"

#include <algorithm>
#include <optional>

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/rational_vectors.h"

namespace nef::planner {
namespace {

// What a convex polytope has in a half-space; nothing if it is not solid.
std::optional<Mesh> clipped(Mesh polytope, const TurningRobot::Face& to) {
  std::vector<Rational> beyond;
  for (const Rational3& v : polytope.vertices) beyond.push_back(dot(to.normal, v) - to.offset);
  const auto [least, most] = std::minmax_element(beyond.begin(), beyond.end());
  if (*most <= 0) return polytope;
  if (*least >= 0) return std::nullopt;
  std::vector<Rational3> points;
  for (std::size_t v = 0; v < beyond.size(); ++v) {
    if (beyond[v] <= 0) points.push_back(polytope.vertices[v]);
  }
  for (std::size_t f = 0; f < polytope.face_count(); ++f) {
    const auto ring = polytope.face(f);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto from = ring[k];
      const auto next = ring[(k + 1) % ring.size()];
      if (!(beyond[from] < 0 && beyond[next] > 0)) continue;  // the face beyond the edge sees it the other way round
      const Rational t = beyond[from] / (beyond[from] - beyond[next]);
      Rational3 point = polytope.vertices[from];
      for (std::size_t c = 0; c < 3; ++c) point[c] += t * (polytope.vertices[next][c] - point[c]);
      points.push_back(point);
    }
  }
  return convex_hull_mesh(points);
}

Mesh turned(Mesh mesh, const AffineMap& rotation) {
  for (Rational3& v : mesh.vertices) v = rotation(v);
  return mesh;
}

std::optional<Mesh> inner_of_piece(const TurningRobot::Piece& piece, const TurningAxis& axis, const Turn& a,
                                   const Turn& b) {
  const AffineMap at_a = axis.rotation(a);
  const AffineMap at_b = axis.rotation(b);
  const Rational tangent = axis.half_tangent_between(a, b);
  const Rational factor = 2 / (1 + axis.square() * tangent * tangent);  // 1 + cos(b - a)
  std::optional<Mesh> rest = turned(piece.mesh, at_a);
  for (const TurningRobot::Face& face : piece.faces) {
    if (rest) rest = clipped(std::move(*rest), {at_b(face.normal), face.offset});
  }
  for (const TurningRobot::Face& face : piece.faces) {
    const Rational3 from = at_a(face.normal);
    const Rational3 to = at_b(face.normal);
    const Rational along = dot(face.normal, axis.direction()) / axis.square();
    Rational3 normal;
    for (std::size_t k = 0; k < 3; ++k) normal[k] = from[k] + to[k] + (factor - 2) * along * axis.direction()[k];
    if (rest) rest = clipped(std::move(*rest), {normal, factor * face.offset});
  }
  return rest;
}

}  // namespace

TurningRobot::TurningRobot(const Polyhedron& robot, const TurningAxis& axis) : robot_(robot), axis_(axis) {
  if (!robot.is_bounded() || robot.is_empty() || !robot.is_regular()) {
    throw InputError("a robot that turns must be a bounded solid without surfaces, curves or points sticking out");
  }
  for (minkowski::ConvexCell& cell : minkowski::decompose(robot)) {
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

Polyhedron TurningRobot::outer(const Turn& a, const Turn& b) const {
  const AffineMap at_a = axis_.rotation(a);
  const AffineMap at_b = axis_.rotation(b);
  const Rational tangent = axis_.half_tangent_between(a, b);
  std::vector<Polyhedron> hulls;
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
    hulls.push_back(convex_hull(points));
  }
  return unite_all(hulls);
}

std::vector<Mesh> TurningRobot::inner_pieces(const Turn& a, const Turn& b) const {
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) {
    if (std::optional<Mesh> inner = inner_of_piece(piece, axis_, a, b)) result.push_back(std::move(*inner));
  }
  return result;
}

Polyhedron TurningRobot::inner(const Turn& a, const Turn& b) const {
  std::vector<Polyhedron> parts;
  for (const Mesh& piece : inner_pieces(a, b)) parts.push_back(convex_hull(piece.vertices));
  return unite_all(parts);
}

}  // namespace nef::planner
