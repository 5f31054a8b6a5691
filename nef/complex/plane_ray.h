// SPDX-License-Identifier: Apache-2.0
//
// Rays inside one plane: which side of an edge a point is on, and which cycles surround it. No
// coordinate is computed: an edge in plane F lies in a second plane G, and the side of G tells.
#pragma once

#include <vector>

#include "nef/complex/complex.h"
#include "nef/geometry/box_tree.h"

namespace nef {

/// The two coordinate axes that remain when the largest component of a plane's normal is dropped;
/// on the plane they are coordinates.
struct PlaneAxes {
  PlaneAxes(const PlaneTable& planes, PlaneId plane);
  int first = 0;  ///< rays go along it, toward smaller values
  int second = 1;
  bool positive = true;  ///< (first, second) turns counterclockwise as seen from the unflipped normal's side

  /// Lexicographic by first, then second.
  [[nodiscard]] int compare(const PointTable& points, PointId a, PointId b) const;
};

/// The plane other than `plane` that holds the edge of a halfedge, and the side of it that lies to
/// the left of the halfedge in `plane` (as seen from the unflipped normal): +1 or -1.
struct EdgeSide {
  PlaneId other;
  int left = 0;
};
EdgeSide edge_side(const PlaneTable& planes, PlaneId plane, const SVertex& halfedge);

/// Where a point of the plane lies, from an edge of the plane: +1 to the left of the halfedge, 0
/// on its line, -1 to the right.
int side_of_edge(const Complex& complex, PlaneId plane, std::uint32_t halfedge, const PointTable& points,
                 PointId point);

/// An edge of some cycle of the plane, and the number of that cycle's owner.
struct PlaneRayEdge {
  std::uint32_t halfedge = kNone;
  std::uint32_t owner = 0;
};

/// Parity of rays toward smaller `first` coordinates, in O(log n + edges met) each.
class PlaneRay {
 public:
  PlaneRay(const Complex& complex, PlaneId plane, const PlaneAxes& axes, std::vector<PlaneRayEdge> edges);

  /// The owners whose edges surround the vertex (which lies in the plane), ascending. Edges that
  /// end at the vertex do not count.
  [[nodiscard]] std::vector<std::uint32_t> owners_with_odd_parity(std::uint32_t vertex) const;

 private:
  const Complex& c_;
  PlaneId plane_;
  PlaneAxes axes_;
  std::vector<PlaneRayEdge> edges_;
  BoxTree tree_;
};

}  // namespace nef
