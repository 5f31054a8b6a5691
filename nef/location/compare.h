// SPDX-License-Identifier: Apache-2.0
//
// Comparison of points that live in two tables: a query point against those of a complex.
#pragma once

#include "nef/base/monitor.h"
#include "nef/geometry/predicates.h"

namespace nef {

/// A point in somebody's table.
struct PointRef {
  const PointTable* table = nullptr;
  PointId id;

  [[nodiscard]] const std::array<double, 3>& approximate() const { return table->approximate(id); }
  [[nodiscard]] IntegerView coordinate(std::size_t column) const { return table->coordinate(id, column); }
};

/// The sign of p[axis] - q[axis], by a double filter, then exactly. O(1).
int compare_coordinate(const PointRef& p, const PointRef& q, int axis, const Monitor& monitor);

/// True if the two are the same point.
bool same_point(const PointRef& p, const PointRef& q, const Monitor& monitor);

/// The sign of the plane's form at the point.
inline int side_of_plane(const PlaneTable& planes, PlaneId plane, const PointRef& p, const Monitor& monitor) {
  return side_of_plane(planes, plane, *p.table, p.id, monitor);
}

}  // namespace nef
