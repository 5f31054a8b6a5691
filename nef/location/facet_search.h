// SPDX-License-Identifier: Apache-2.0
//
// Where a point of a facet's plane lies with respect to that facet.
#pragma once

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/location/compare.h"

namespace nef {

/// The vertex, edge (as one of its halfedges) or facet in the closure of a facet that contains `point`, which must lie
/// on its plane; none if the point lies outside. Isolated vertices are disregarded: there, it is the facet. `edges`, if
/// given, is the tree made by facet_edge_tree; without it the cost is linear in the number of corners.
ItemRef locate_in_facet(const Complex& complex, FacetId facet, const PointRef& point, const BoxTree* edges,
                        const Monitor& monitor);

/// The tree over the boundary edges of a facet: item i is the edge that leaves corner i of
/// complex.corners_of(facet).
BoxTree facet_edge_tree(const Complex& complex, const Facet& facet);

/// The box around a point.
Box point_box(const PointRef& point);

/// The box reflected at the origin.
Box mirrored(const Box& box);

}  // namespace nef
