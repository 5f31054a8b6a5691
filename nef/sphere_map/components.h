// SPDX-License-Identifier: Apache-2.0
//
// Which boundary cycles of a sphere map bound the same sface, when the map is not connected.
#pragma once

#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// Joins boundary cycles into sfaces. `cycle_of_half` names the cycle of every shalfedge,
/// `cycle_of_vertex` that of every isolated svertex (kNone for others), `cycle_of_loop` those of
/// the two sides of a sloop, if there is one. Only incidences, svertices and sloops of `map` are
/// used. Returns for every cycle a representative; cycles of one sface have the same one, the smallest of them.
/// O(size) per connected component of the map.
std::vector<std::uint32_t> join_cycles(const PlaneTable& planes, const SphereMapView& map,
                                       const std::vector<std::uint32_t>& cycle_of_half,
                                       const std::vector<std::uint32_t>& cycle_of_vertex,
                                       const std::vector<std::uint32_t>& cycle_of_loop, std::uint32_t cycle_count,
                                       const Monitor& monitor);

}  // namespace nef
