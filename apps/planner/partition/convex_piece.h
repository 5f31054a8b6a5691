// SPDX-License-Identifier: Apache-2.0
//
// Closed convex polygons, segments and points given by planes, and how a plane splits them. New
// vertices are meetings of three planes, so they are exact and no coordinate is ever rounded.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/partition/cells.h"
#include "nef/base/monitor.h"
#include "nef/geometry/plane_table.h"
#include "nef/geometry/point_table.h"

namespace nef::planner {

/// A closed convex set of dimension 0, 1 or 2.
struct ConvexPiece {
  CellId cell = kNoCell;  ///< what its relative interior belongs to
  int dimension = 0;
  PlaneId p;                    ///< dimension 2: its plane; 1: one of two planes that meet in its line
  PlaneId q;                    ///< dimension 1: the other plane
  std::vector<PointId> points;  ///< 1, 2, or the polygon in order
  /// Dimension 2: the plane through points i and i+1 that is not p.
  std::vector<PlaneId> sides;
  /// Dimension 2: side i separates this piece from another piece of the same facet.
  std::vector<bool> seams;
};

/// What a plane makes of a piece. `on` may have the dimension of the piece, if it lies in the
/// plane, or one less.
struct SplitPiece {
  std::optional<ConvexPiece> negative;
  std::optional<ConvexPiece> on;
  std::optional<ConvexPiece> positive;
};

/// Splits a piece by the unflipped plane. New points are appended to `points`. A polygon that only
/// touches the plane has an `on` part where a seam lies in the plane; a segment wherever it touches.
SplitPiece split(ConvexPiece&& piece, PlaneId plane, const PlaneTable& planes, PointTable& points,
                 const Monitor& monitor);

/// The part of a plane inside the box whose planes are given (low x, high x, low y, ...); without
/// those of the plane's main axis, so it may stick out in that direction.
ConvexPiece plane_in_box(PlaneId plane, const std::array<PlaneId, 6>& box, const PlaneTable& planes,
                         PointTable& points);

/// The mean of the piece's points, a point of its relative interior.
Rational3 centre(const ConvexPiece& piece, const PointTable& points);

/// Appends closed convex polygons whose union is the closure of facet `f`. A convex facet is one
/// piece. Others are cut along the lines of their boundary edges: O(k^2) pieces at worst for k
/// edges. New points are appended to `points`, which begins with the points of the complex; `planes`
/// begins with its planes.
void append_facet_pieces(const Complex& complex, FacetId f, CellId cell, const PlaneTable& planes, PointTable& points,
                         const std::array<PlaneId, 6>& box, std::vector<ConvexPiece>& pieces, const Monitor& monitor);

}  // namespace nef::planner
