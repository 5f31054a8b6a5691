// SPDX-License-Identifier: Apache-2.0
//
// What keeps volumes and facets of a complex from being convex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef::minkowski {

/// An edge about which a selected volume takes more than a half-turn. By Tietze's theorem a volume
/// without such edges (and without missing points) is convex.
struct ReflexEdge {
  std::uint32_t halfedge = 0;
  std::uint32_t volume = 0;
  int axis = 2;                  ///< walls go along z; for an edge parallel to z, along y
  std::array<bool, 2> inside{};  ///< whether the volume goes on from the edge against / along the axis
};

/// All reflex edges of volumes with a label for which (label & 1) is set. O(n).
std::vector<ReflexEdge> reflex_edges(const Complex& complex);

/// Vertices that are alone inside such a volume. O(n).
std::vector<std::uint32_t> lonely_vertices(const Complex& complex);

/// A corner at which a facet takes more than a half-turn, or a vertex alone inside a facet.
struct ReflexCorner {
  std::uint32_t vertex = 0;
  std::array<bool, 2> inside{};  ///< whether the facet goes on against / along the cut direction
};

/// The direction in which facets of this plane are cut; any that lies in the plane would do.
Direction cut_direction(const Complex& complex, PlaneId plane);

/// All reflex corners of one facet; none iff the facet is convex. O(size of the facet).
std::vector<ReflexCorner> reflex_corners(const Complex& complex, std::uint32_t facet);

}  // namespace nef::minkowski
