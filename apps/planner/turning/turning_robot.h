// SPDX-License-Identifier: Apache-2.0
//
// A robot over a range of angles, from outside and from inside.
#pragma once

#include <vector>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/turning/turn.h"
#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"

namespace nef::planner {

/// The robot itself; throws InputError unless it is a bounded solid, as one that turns must be.
const Polyhedron& turning_robot(const Polyhedron& robot);

/// How far a robot's farthest point is from its reference point at most, in doubles: that of a corner of the box around
/// it.
double reach_of(const Polyhedron& robot);

/// A solid robot that turns about an axis through its reference point, the origin.
class TurningRobot {
 public:
  /// A convex piece.
  struct Piece {
    Mesh mesh;
    std::vector<HalfSpace> faces;
  };

  /// Cuts the robot into convex pieces. Throws as require_turning_robot.
  TurningRobot(const Polyhedron& robot, const TurningAxis& axis, const Monitor& monitor = {});

  [[nodiscard]] const TurningAxis& axis() const { return axis_; }
  /// Without common interior; their union is the robot.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// The convex pieces of the robot turned.
  [[nodiscard]] std::vector<Mesh> pieces_at(const Turn& turn) const;

  /// Convex pieces that hold the robot at every angle from a to b, which are less than a half turn apart: for each
  /// piece of the robot the hull of its vertices at both ends and, for each vertex, the meeting point of the tangents
  /// to its arc there.
  [[nodiscard]] std::vector<Mesh> outer_pieces(const Turn& a, const Turn& b, const Monitor& monitor = {}) const;

  /// Lies in the robot at every angle from a to b: for each piece that leaves something, what its turned copies at both
  /// ends and, for each face n x <= c, the half-space M n x <= c have in common, M being that of TurningAxis::between.
  /// With h the part of n across the axis, m the part along it and d = b - a the latter is (h_a + h_b + (1 + cos d) m)
  /// x <= (1 + cos d) c: where h_t x has its maximum over t inside the range, (h_a + h_b) x is at least 1 + cos d times
  /// that.
  [[nodiscard]] std::vector<Mesh> inner_pieces(const Turn& a, const Turn& b) const;

 private:
  TurningAxis axis_;
  std::vector<Piece> pieces_;
};

}  // namespace nef::planner
