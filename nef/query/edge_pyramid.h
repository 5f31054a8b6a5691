// SPDX-License-Identifier: Apache-2.0
//
// The local pyramid of a point inside an edge.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef {

/// The sphere map of any point in the relative interior of an edge: svertex 0 is the direction of
/// `halfedge`, svertex 1 its antipode; arc i (shalfedge 2i, from svertex 0 to 1) is the half
/// circle of the i-th facet around the edge, counterclockwise beginning with the svertex's `out`;
/// sface i lies to its left. An edge without facets has one sface. If `sfaces` is given, element i
/// becomes the global index of the sface of the complex (at the source of `halfedge`) that local
/// sface i is part of. O(degree of the edge).
void edge_pyramid(const Complex& complex, std::uint32_t halfedge, SphereMapBuffer& out,
                  std::vector<std::uint32_t>* sfaces = nullptr);

}  // namespace nef
