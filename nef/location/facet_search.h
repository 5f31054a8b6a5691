// SPDX-License-Identifier: Apache-2.0
//
// Where a point of a facet's plane lies with respect to that facet.
#pragma once

#include <cstdint>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/geometry/box_tree.h"
#include "nef/location/compare.h"

namespace nef {

/// A place in the closure of a facet, isolated vertices disregarded.
struct FacetPlace {
  enum class Kind : std::uint8_t { kOutside, kInside, kEdge, kVertex };
  Kind kind = Kind::kOutside;
  std::uint32_t index = 0;  ///< kEdge: a halfedge; kVertex: a vertex
  [[nodiscard]] VertexId vertex() const { return VertexId{index}; }
  [[nodiscard]] HalfedgeId halfedge() const { return HalfedgeId{index}; }
};

/// The place of `point`, which must lie on the plane of the facet. `edges`, if given, is the tree
/// made by facet_edge_tree; without it the cost is linear in the number of corners.
FacetPlace locate_in_facet(const Complex& complex, const Facet& facet, const PointRef& point, const BoxTree* edges,
                           const Monitor& monitor);

/// The tree over the boundary edges of a facet: item i is the edge that leaves corner i of
/// complex.corners_of(facet).
BoxTree facet_edge_tree(const Complex& complex, const Facet& facet);

/// The box around a point.
Box point_box(const PointRef& point);

/// The box reflected at the origin.
Box mirrored(const Box& box);

}  // namespace nef
