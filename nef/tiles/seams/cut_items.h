// SPDX-License-Identifier: Apache-2.0
//
// What tiles look like at points of their walls where edges and facets of the whole were cut, and no vertex of it is.
#pragma once

#include <cstdint>
#include <optional>

#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// A tile at a point of one wall where it is one edge with its facets that ends there: the same all along that edge,
/// kOutside beyond the wall. Asks the pattern of the map alone: `in_wall` has a bit for each pair of shalfedges that
/// lies in the plane of the wall. The pairs that lie in facets; none if it looks otherwise. Where the tiles on both
/// sides have such maps at a point with the same two planes among those of the facets, the edge goes on straight: no
/// vertex of the whole is there. O(size of the map).
std::uint64_t facets_of_cut_edge(const SphereMapView& pattern, std::uint64_t in_wall);

/// The inside of a facet that walls cut, in a pattern: a shalfedge in its plane, and marks on it and to both sides.
struct CutFacet {
  std::uint32_t shalfedge = 0;
  LabelId mark = 0;
  LabelId left = 0;
  LabelId right = 0;
};

/// A tile at a point of several walls where it is the inside of a facet that all of them cut; nothing if it looks
/// otherwise. Where all tiles that have a vertex at a point have the same plane and marks there, no vertex of the whole
/// is there: one that has none there either has the same facet, or ends in a wall that the facet cuts along a line,
/// along which it does not change. Asks the pattern alone, `in_wall` is as above. O(size of the map).
std::optional<CutFacet> cut_facet(const SphereMapView& pattern, std::uint64_t in_wall);

}  // namespace nef
