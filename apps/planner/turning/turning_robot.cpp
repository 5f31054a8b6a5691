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

// With R(p) to R(q) the rotations from a to b, M(p, q) n x <= c is the half-space of a face's chord.
std::optional<Mesh> inner_of_piece(const TurningRobot::Piece& piece, const TurningAxis& axis, const Turn& a,
                                   const Turn& b) {
  std::optional<Mesh> rest = turned(piece.mesh, axis.rotation(a));
  for (const AffineMap& map : {axis.rotation(b), axis.between(a, b)}) {
    for (const HalfSpace& face : piece.faces) {
      if (rest) rest = clipped(std::move(*rest), map(face.normal), face.offset);
    }
  }
  return rest;
}

}  // namespace

const Polyhedron& turning_robot(const Polyhedron& robot) {
  if (!robot.is_bounded() || robot.is_empty() || !robot.is_regular()) {
    throw InputError("a robot that turns must be a bounded solid without surfaces, curves or points sticking out");
  }
  return robot;
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

TurningRobot::TurningRobot(const Polyhedron& robot, const TurningAxis& axis, const Monitor& monitor) : axis_(axis) {
  for (minkowski::ConvexCell& cell : minkowski::decompose(turning_robot(robot), monitor)) {
    if (cell.dimension < 3) continue;  // walls between solid cells
    std::vector<HalfSpace> faces = half_spaces_of(cell.mesh);
    pieces_.push_back({std::move(cell.mesh), std::move(faces)});
  }
}

std::vector<Mesh> TurningRobot::pieces_at(const Turn& turn) const {
  const AffineMap rotation = axis_.rotation(turn);
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) result.push_back(turned(piece.mesh, rotation));
  return result;
}

std::vector<Mesh> TurningRobot::outer_pieces(const Turn& a, const Turn& b, const Monitor& monitor) const {
  const std::array<AffineMap, 3> maps{axis_.rotation(a), axis_.between(a, b), axis_.rotation(b)};
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) {
    std::vector<Rational3> points;
    for (const Rational3& v : piece.mesh.vertices) {
      for (const AffineMap& map : maps) points.push_back(map(v));
    }
    result.push_back(convex_hull_mesh(points, monitor));
  }
  return result;
}

std::vector<Mesh> TurningRobot::inner_pieces(const Turn& a, const Turn& b) const {
  std::vector<Mesh> result;
  for (const Piece& piece : pieces_) {
    if (std::optional<Mesh> inner = inner_of_piece(piece, axis_, a, b)) result.push_back(std::move(*inner));
  }
  return result;
}

}  // namespace nef::planner
