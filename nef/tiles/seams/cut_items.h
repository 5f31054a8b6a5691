// SPDX-License-Identifier: Apache-2.0
//
// What tiles look like at points of their walls where edges and facets of the whole were cut, and no vertex of it is.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// A tile at a point of one wall (by its row) where it is one edge with its facets that ends there: the same all along
/// that edge, kOutside beyond the wall. The two smallest rows of the facets' planes, in a common table of which rows[r]
/// is row r of the map; nothing if it looks otherwise, or if all facets lie in one plane. Where the tiles on both sides
/// have the same rows at a point, the edge goes on straight: no vertex of the whole is there. O(size of the map).
std::optional<std::array<std::uint32_t, 2>> planes_of_cut_edge(const SphereMapView& map, std::uint32_t wall,
                                                               std::span<const std::uint32_t> rows);

/// The inside of a facet: its plane, and marks on it and on both sides of the unflipped plane.
struct FacetInside {
  std::uint32_t row = kNone;
  LabelId mark = 0;
  LabelId above = 0;
  LabelId below = 0;
  bool operator==(const FacetInside&) const = default;
};

/// A tile at a point of several walls (by their rows) where it is the inside of a facet that all of them cut; nothing
/// if it looks otherwise. Where all tiles that have a vertex at a point say the same, no vertex of the whole is there:
/// one that has none there either has the same facet, or ends in a wall that the facet cuts along a line, along which
/// it does not change. O(size of the map).
std::optional<FacetInside> cut_facet(const SphereMapView& map, std::span<const std::uint32_t> walls,
                                     std::span<const std::uint32_t> rows);

}  // namespace nef
