// SPDX-License-Identifier: Apache-2.0
//
// The indices of the items of a complex.
#pragma once

#include "nef/base/id.h"
#include "nef/geometry/ids.h"

namespace nef {

using CycleId = Id<struct CycleTag>;          ///< a closed part of the boundary of a facet
using FacetId = Id<struct FacetTag>;          ///< both sides of a facet
using HalfedgeId = Id<struct HalfedgeTag>;    ///< an edge as it leaves one of its ends: an svertex of the complex
using HalffacetId = Id<struct HalffacetTag>;  ///< one side of a facet
using PatternId = Id<struct PatternTag>;      ///< a sphere map without its planes
using SHalfedgeId = Id<struct SHalfedgeTag>;  ///< an arc in the sphere map of its vertex, in one of its directions
using SFaceId = Id<struct SFaceTag>;          ///< an sface of the complex: a volume as a vertex of its boundary sees it
using ShellId = Id<struct ShellTag>;
using VertexId = Id<struct VertexTag>;
using VolumeId = Id<struct VolumeTag>;

/// Volume 0.
inline constexpr VolumeId kOuterVolume{0};

/// Where a vertex lies, in the points of its complex.
constexpr PointId point_of(VertexId vertex) { return PointId{vertex.index()}; }

/// The same arc in the other direction; of two twins, the even one stands first.
constexpr SHalfedgeId twin_of(SHalfedgeId shalfedge) { return SHalfedgeId{shalfedge.index() ^ 1U}; }
/// The number of the pair of twins that a shalfedge belongs to.
constexpr std::uint32_t pair_of(SHalfedgeId shalfedge) { return shalfedge.index() >> 1U; }
constexpr bool is_odd(SHalfedgeId shalfedge) { return (shalfedge.index() & 1U) != 0; }

/// Halffacet 2f is facet f seen from the positive side of its unflipped plane, 2f + 1 from the other side.
constexpr HalffacetId halffacet_of(FacetId facet, bool below) {
  return HalffacetId{2 * facet.index() + (below ? 1U : 0U)};
}
constexpr FacetId facet_of(HalffacetId halffacet) { return FacetId{halffacet.index() >> 1U}; }
constexpr bool is_below(HalffacetId halffacet) { return (halffacet.index() & 1U) != 0; }
/// The other side of the same facet.
constexpr HalffacetId opposite(HalffacetId halffacet) { return HalffacetId{halffacet.index() ^ 1U}; }

}  // namespace nef
