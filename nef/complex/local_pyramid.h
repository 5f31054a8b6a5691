// SPDX-License-Identifier: Apache-2.0
//
// Local pyramids of the points of any item: of a vertex, inside an edge or a facet, in a volume.
#pragma once

#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"

namespace nef {

/// The local pyramid of a point inside the edge that leaves along `svertex` of `map`: svertex 0 of
/// the result has its direction, svertex 1 the opposite one; sface i of the result is sface
/// `sfaces[i]` of `map`. O(number of facets around the edge).
void edge_pyramid(const SphereMapView& map, std::uint32_t svertex, SphereMapBuffer& out,
                  std::vector<std::uint32_t>* sfaces = nullptr);

/// The mark of an item, which must not be none.
LabelId mark_of(const Complex& complex, const ItemRef& item);

/// The local pyramid of the points of an item, which must not be none; an edge seen along the halfedge that names it.
/// O(its size).
void pyramid_of(const Complex& complex, const ItemRef& item, SphereMapBuffer& out);

/// True if a point with this simplified sphere map is a vertex of the complex, and not a point
/// inside a volume, facet or edge.
bool is_vertex(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor);

}  // namespace nef
