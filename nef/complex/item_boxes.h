// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/complex/complex.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {

// Boxes of doubles around exact items: rounded outward, so that items whose boxes do not meet do not meet either.
Box vertex_box(const Complex& complex, VertexId vertex);
Box edge_box(const Complex& complex, HalfedgeId halfedge);
Box facet_box(const Complex& complex, const Facet& facet);
// Around all vertices; empty if there are none.
Box vertices_box(const Complex& complex);

}  // namespace nef
