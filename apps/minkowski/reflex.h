// SPDX-License-Identifier: Apache-2.0
//
// What keeps volumes and facets of a complex from being convex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef::minkowski {

/// A way to divide the angle of a vertical reflex edge: an upright wall that prolongs one of the two
/// facets at which the volume begins and ends; that leaves a half-turn on one side and less on the other.
struct CrossWall {
  PlaneId plane;                 ///< invalid for the plane x = const
  std::array<bool, 2> inside{};  ///< towards smaller, larger values of cross_axis(plane)
};

/// An edge about which a selected volume takes more than a half-turn. By Tietze's theorem a volume
/// without such edges (and without missing points) is convex.
struct ReflexEdge {
  std::uint32_t halfedge = 0;
  std::uint32_t volume = 0;
  bool vertical = false;                ///< parallel to z; others get walls along z
  std::array<bool, 2> inside{};         ///< if not vertical: whether the volume goes on below, above the edge
  std::array<CrossWall, 2> cross_wall;  ///< if vertical: either one will do
};

/// The coordinate along which a wall in an upright plane is swept: x, or y if x is constant there.
int cross_axis(const Complex& complex, PlaneId plane);

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
