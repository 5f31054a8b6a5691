// SPDX-License-Identifier: Apache-2.0
//
// Convex pieces of a facet.
#pragma once

#include "apps/planner/partition/convex_piece.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Appends closed convex polygons whose union is the closure of facet `f`. A convex facet is one
/// piece. Others are cut along the lines of their boundary edges: O(k^2) pieces at worst for k
/// edges. New points are appended to `points`, which begins with the points of the complex; `planes`
/// begins with its planes.
void append_facet_pieces(const Complex& complex, FacetId f, CellId cell, const PlaneTable& planes, PointTable& points,
                         const std::array<PlaneId, 6>& box, std::vector<ConvexPiece>& pieces, const Monitor& monitor);

}  // namespace nef::planner
