// SPDX-License-Identifier: Apache-2.0
//
// Cross-sections with a plane.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef {

/// A bounded polygon in space: simple up to corners that a ring passes more than once (where a hole touches the outer
/// ring, both are one ring). Seen from the side to which the normal of the section points, the outer ring runs
/// counterclockwise and holes clockwise. No corner lies on the straight line between its neighbours.
struct SectionPolygon {
  std::vector<Rational3> outer;
  std::vector<std::vector<Rational3>> holes;
};

/// What a plane cuts from a set.
struct Section {
  /// The exact intersection of the set and the plane: open and closed where the set is.
  Polyhedron set;
  /// The closures of its two-dimensional parts, without common interior.
  std::vector<SectionPolygon> polygons;
  /// Of its closure, what no polygon holds: segments (lexicographically smaller end first) and points.
  std::vector<std::array<Rational3, 2>> segments;
  std::vector<Rational3> points;
  /// Polygons and segments that reach infinity: they are in `set` only.
  std::size_t unbounded = 0;
};

/// The section of the set with the plane of all points x with normal . x + offset = 0. Throws InputError if the normal
/// is zero. One Boolean operation with the plane: O(n) and O(k log k) for k items in the section.
Section section(const Polyhedron& a, const Rational3& normal, const Rational& offset, const Monitor& monitor = {});

/// The plane itself: all points x with normal . x + offset = 0. Throws InputError if the normal is zero.
Polyhedron plane_of_section(const Rational3& normal, const Rational& offset, const Monitor& monitor = {});

}  // namespace nef
