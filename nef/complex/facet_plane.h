// SPDX-License-Identifier: Apache-2.0
//
// The plane of facets as a place of two coordinates, and which side of an edge in it a point is on. No coordinate is
// computed: an edge in plane F lies in a second plane G, and the side of G tells.
#pragma once

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef {

/// The two coordinate axes that remain when the largest component of a plane's normal is dropped;
/// on the plane they are coordinates.
struct PlaneAxes {
  PlaneAxes(const PlaneTable& planes, PlaneId plane);
  int first = 0;
  int second = 1;
  int dropped = 2;
  bool positive = true;  ///< (first, second) turns counterclockwise as seen from the unflipped normal's side

  /// Lexicographic by first, then second.
  [[nodiscard]] int compare(const PointTable& points, PointId a, PointId b, const Monitor& monitor) const;
};

/// The plane other than `plane` that holds the edge of a halfedge, and the side of it that lies to
/// the left of the halfedge in `plane` (as seen from the unflipped normal): +1 or -1.
struct EdgeSide {
  PlaneId other;
  int left = 0;
};
EdgeSide edge_side(const PlaneTable& planes, PlaneId plane, const SVertex& halfedge, const Monitor& monitor);

/// Where a point of the plane lies, from an edge of the plane: +1 to the left of the halfedge, 0
/// on its line, -1 to the right.
int side_of_edge(const Complex& complex, PlaneId plane, HalfedgeId halfedge, const PointTable& points, PointId point,
                 const Monitor& monitor);

}  // namespace nef
