// SPDX-License-Identifier: Apache-2.0
//
// What lies straight below a vertex in the plane of facets: a sweep over the plane from smaller to greater values of
// its first coordinate (ties in order of the second, as if the plane were turned a hair), with the edges that meet the
// sweep line in the order of the second coordinate. Nothing is counted and no parity taken, so that edges which end at
// the vertex, or cycles that share a border or touch, cannot mislead.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/facet_plane.h"

namespace nef {

/// The answer for one vertex, as indices into what was asked.
struct CornerBelow {
  std::uint32_t query = kNone;   ///< into `vertices`
  std::uint32_t corner = kNone;  ///< into `corners`; kNone if nothing is below
};

/// For each of `vertices`, none of which may be the greater end of an edge: the one of `corners` whose edge is the
/// first that a ray from the vertex toward smaller second coordinates meets, among the edges with their facet above. If
/// the vertex sees a facet below itself, that is the facet of this corner. Corners and vertices lie in the unflipped
/// `plane`; edges do not cross. The answers come in lexicographic order of the vertices, first coordinate first. O(n
/// log n) for n corners and vertices together.
std::vector<CornerBelow> corners_below(const Complex& complex, PlaneId plane, std::span<const SHalfedgeId> corners,
                                       std::span<const VertexId> vertices, const Monitor& monitor);

}  // namespace nef
