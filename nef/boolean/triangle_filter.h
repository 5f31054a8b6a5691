// SPDX-License-Identifier: Apache-2.0
//
// Whether a line misses a triangle, in double precision with a proven bound: most edges that pass through the plane of
// a facet pass beside the facet, and need no exact point to know it.
#pragma once

#include <array>

#include "nef/geometry/point_table.h"

namespace nef {

/// True only if the line through points a and b misses the closed triangle. The ends lie strictly on two sides of the
/// triangle's plane. False where doubles do not tell: at infinity, near an edge, and if fast paths are off. O(1).
bool surely_misses_triangle(const PointTable& points, PointId a, PointId b, const std::array<PointId, 3>& triangle);

}  // namespace nef
