// SPDX-License-Identifier: Apache-2.0
//
// What a plane leaves of an edge that crosses it.
#pragma once

#include <cstddef>

#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// The local pyramid at the point where a plane crosses the edge that leaves along `svertex` of `map` to the positive
/// side of the plane: on the side 0 (below) or 1 (above) and on the plane as it was, kOutside beyond. svertex 0 of the
/// result is what is left of the edge. False if it is not one that can be written down without a look at coordinates:
/// an edge without facets, or one that more than one sface of kOutside meets. O(number of facets around the edge).
bool half_of_cut_edge(const SphereMapView& map, std::uint32_t svertex, PlaneId plane, std::size_t side,
                      SphereMapBuffer& out);

}  // namespace nef
