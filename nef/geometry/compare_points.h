// SPDX-License-Identifier: Apache-2.0
//
// Comparisons of points that are in different tables.
#pragma once

#include "nef/base/monitor.h"
#include "nef/geometry/point_table.h"

namespace nef {

/// The sign of p[axis] - q[axis] for a point of `points` and one of `others`, as compare_coordinate of two points of
/// one table.
int compare_coordinate(const PointTable& points, PointId p, const PointTable& others, PointId q, int axis,
                       const Monitor& monitor);

}  // namespace nef
