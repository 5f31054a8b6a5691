// SPDX-License-Identifier: Apache-2.0
//
// A robot over a range of angles, from outside and from inside.
#pragma once

#include <vector>

#include "apps/planner/turning/turn.h"

namespace nef::planner {

/// A solid robot that turns about a coordinate axis through its reference point, the origin.
class TurningRobot {
 public:
  /// Cuts the robot into convex pieces. Throws InputError unless the robot is a bounded solid.
  TurningRobot(const Polyhedron& robot, std::size_t axis);

  [[nodiscard]] std::size_t axis() const { return axis_; }
  /// The robot turned.
  [[nodiscard]] Polyhedron at(const Turn& turn) const { return transform(robot_, rotation_of(turn, axis_)); }

  /// Holds the robot at every angle from a to b, which lie in one quarter: for each piece the hull of its vertices at
  /// both ends and, for each vertex, the meeting point of the tangents to its arc there.
  [[nodiscard]] Polyhedron outer(const Turn& a, const Turn& b) const;

  /// Lies in the robot at every angle from a to b: for each piece what its turned copies at both ends and, for each
  /// face n x <= c, the half-space of the chord have in common. With h the part of n across the axis and d = b - a the
  /// latter is (h_a + h_b) x + (1 + cos d) n_z z <= (1 + cos d) c: where h_t x has its maximum over t inside the
  /// range, (h_a + h_b) x is at least 1 + cos d times that. May be empty.
  [[nodiscard]] Polyhedron inner(const Turn& a, const Turn& b) const;

  /// The parts across the axis of the normals of all faces of the pieces.
  [[nodiscard]] std::vector<std::array<Rational, 2>> normals() const;

 private:
  struct Face {
    Rational3 normal;  ///< outward
    Rational offset;   ///< normal * x <= offset
  };
  struct Piece {
    std::vector<Rational3> vertices;
    std::vector<Face> faces;
  };
  [[nodiscard]] Polyhedron inner_of_piece(const Piece& piece, const Turn& a, const Turn& b) const;

  Polyhedron robot_;
  std::size_t axis_;
  std::vector<Piece> pieces_;
};

}  // namespace nef::planner
