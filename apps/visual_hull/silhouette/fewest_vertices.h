// SPDX-License-Identifier: Apache-2.0
//
// The polygon of fewest vertices within a tolerance, chosen among the vertices of a ring.
#pragma once

#include "apps/visual_hull/polygon/polygon.h"

namespace nef::visual_hull {

/// Distance of a point from a segment, in double precision.
double distance_to_segment(const std::array<double, 2>& p, const std::array<double, 2>& a,
                           const std::array<double, 2>& b);

/// Which vertices of the ring to keep, so that all between two kept neighbours lie within `tolerance`
/// of the segment between them, and as few as possible are kept (for one fixed vertex, which is always
/// kept); of equals, those with the smallest sum of squared deviations. Vertices with `pinned` are kept. Topology
/// is not looked at. A shortest path over admissible segments (Imai and Iri 1988), with the wedge of directions
/// that pass near all vertices so far to end the search (Chan and Chin 1996): O(n w^2) for segments that
/// span up to w vertices.
std::vector<bool> fewest_vertices(const Ring& ring, const std::vector<bool>& pinned, double tolerance);

}  // namespace nef::visual_hull
