// SPDX-License-Identifier: Apache-2.0
//
// Are two convex polytopes apart, do they overlap? In doubles with proven bounds; what these leave open is for
// hulls_apart.h.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_cell.h"
#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

/// What doubles know of two polytopes.
enum class Separation : std::uint8_t {
  kApart,        ///< a plane lies between them, neither touches it
  kOverlapping,  ///< they have a point in common, and those with an inside one that is in it
  kPerhaps,      ///< a plane lies between them or touches them, as far as doubles can tell
  kUnknown       ///< no such plane was found
};

/// One of two polytopes in doubles: points whose coordinates are off by kImageError reach + kVanished at most, and
/// directions of length 1 or less in which a separating plane is looked for first.
struct RoughPolytope {
  std::vector<Vector3d> points;
  std::vector<Vector3d> normals;
  double reach = 0;  ///< no coordinate of a point is larger
  double slack = 0;  ///< the polytope may be larger than its points by a ball of this radius
  void clear() {
    points.clear();
    normals.clear();
  }
};

/// Makes the rough polytope of what a piece sweeps in a part of a motion, or of a piece that stays.
void place(const RigidBody::Piece& piece, const MotionCell& cell, RoughPolytope& result);
void place(const RigidBody::Piece& piece, RoughPolytope& result);

/// Gives what place() has made one normal for each face, turned as in the first pose of the cell, as overlap() wants
/// it: place() adds the opposite ones of flat pieces.
void keep_face_normals(const RigidBody::Piece& piece, const MotionCell& cell, RoughPolytope& result);

/// Looks for a plane between two polytopes: kApart, kPerhaps or kUnknown. If kApart, `normal`, if it is given, receives
/// the normal of the plane, which points from a to b.
Separation plane_between(const RoughPolytope& a, const RoughPolytope& b, Vector3d* normal = nullptr);

/// Do two pieces overlap, the first one moved? Its points are given as `a`, its normals turned with it. kOverlapping
/// only if they do wherever the first one is moved by `slack` or less; otherwise kUnknown.
Separation overlap(const RigidBody::Piece& piece_a, const RoughPolytope& a, const RigidBody::Piece& piece_b,
                   double slack);

}  // namespace nef::planner
