// SPDX-License-Identifier: Apache-2.0
//
// Which directions of motion are blocked where two solids touch.
#pragma once

#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef::planner {

/// The directions d with n * d < 0 for all of the normals n: an open convex cone. Normals have no common factors, and
/// are in order. Without normals: all directions.
using OpenCone = std::vector<Integer3>;

/// True if a direction is in the cone.
bool contains(const OpenCone& cone, const Rational3& direction);

/// The cone of the directions -d.
OpenCone opposite_cone(const OpenCone& cone);

/// The inside of the cone that some vectors span: without normals if that is all of space, or flat. O(n^3).
OpenCone inside_of_hull(const std::vector<Rational3>& vectors);

/// How two solids that do not overlap touch.
struct ContactCones {
  /// The union of these is what a is blocked in while b rests: if a moves in one of these directions, however little,
  /// it overlaps b. Each cone once, and none that is in one of the others with a single normal.
  std::vector<OpenCone> blocked;
  std::optional<Rational3> point;  ///< where they touch, if they do
};

/// Looks at all places where two solids touch; nothing if they overlap. Both must be open, bounded, and the interiors
/// of their closures (nef::interior of a solid).
///
/// At a point that both touch, a is blocked in the differences of the interiors of b's local pyramid and a's. These
/// sets are largest at the vertices of the arrangement of both boundaries, so only these are looked at. If the
/// complement of a pyramid is convex (a facet, an edge that is no valley, ...), the differences are all directions that
/// lead behind one of its planes; otherwise the pyramids are cut into convex cones, and each pair of these gives an
/// open cone, unless facets that look against each other say as much. O(k log n) for k pairs of an edge and a facet
/// that come near, and O(d^3) for each contact at vertices of d edges that needs those cones.
std::optional<ContactCones> contact_cones(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});

}  // namespace nef::planner
