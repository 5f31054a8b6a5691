// SPDX-License-Identifier: Apache-2.0
//
// Planes through points, in lowest terms without a division of long numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nef/geometry/plane_table.h"
#include "nef/geometry/point_table.h"
#include "nef/geometry/vectors.h"

namespace nef {

/// Interns planes through finite points. Keeps the memory of its numbers from plane to plane; one for each thread.
class PlaneFinder {
 public:
  /// The plane through o of a normal, which is not zero; its positive side is where the normal points. O(1).
  PlaneId through(PlaneTable& planes, const PointTable& points, const Integer3& normal, PointId o);

  /// The plane of three points, seen counterclockwise from its positive side; no plane if they are on one line. O(1):
  /// in machine integers where the numbers are short, which gives the same plane
  /// (tests/core/geometry/plane_finder_test).
  PlaneId through(PlaneTable& planes, const PointTable& points, PointId o, PointId p, PointId q);

  /// The same of three points whose coordinates are these integers over one denominator; all are below 2^62. Nothing if
  /// numbers on the way would be long.
  static std::optional<PlaneId> through(PlaneTable& planes, const std::array<std::array<std::int64_t, 3>, 3>& corners,
                                        std::int64_t denominator);

 private:
  struct SmallSides;
  static std::optional<PlaneId> through_small(PlaneTable& planes, const SmallSides& sides);
  PlaneId with_normal(PlaneTable& planes, const PointTable& points, PointId o);

  Integer3 u_, v_, n_;
  Integer offset_;
};

/// The first of these planes, and the same in rationals.
inline PlaneId plane_through(PlaneTable& planes, const PointTable& points, const Integer3& normal, PointId o) {
  return PlaneFinder().through(planes, points, normal, o);
}
inline PlaneId plane_through(PlaneTable& planes, const Rational3& normal, const Rational3& point) {
  return planes.intern(normal, Rational(-dot(normal, point)));
}

}  // namespace nef
