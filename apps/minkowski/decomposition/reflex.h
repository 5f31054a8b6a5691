// SPDX-License-Identifier: Apache-2.0
//
// What keeps volumes and facets of a complex from being convex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef::minkowski {

// Walls stand along one axis, 0 to 2: "vertical" and "upright" mean parallel to it, "up" towards larger values.

/// A way to divide the angle of a vertical reflex edge: an upright wall that prolongs one of the two
/// facets at which the volume begins and ends; that leaves a half-turn on one side and less on the other.
struct CrossWall {
  PlaneId plane;                 ///< invalid for the plane where the coordinate after the axis is constant
  std::array<bool, 2> inside{};  ///< towards smaller, larger values of cross_axis(plane, axis)
};

/// An edge about which a selected volume takes more than a half-turn. By Tietze's theorem a volume
/// without such edges (and without missing points) is convex.
struct ReflexEdge {
  HalfedgeId halfedge{0};
  VolumeId volume = kOuterVolume;
  bool vertical = false;                ///< parallel to the axis; others get walls along the axis
  std::array<bool, 2> inside{};         ///< if not vertical: whether the volume goes on below, above the edge
  std::array<CrossWall, 2> cross_wall;  ///< if vertical: either one will do
};

/// The direction of a coordinate axis, or against it if `way` is -1.
Direction along_axis(std::size_t axis, int way);

/// The coordinate along which a wall in an upright plane is swept: the one after `axis` in the order x, y, z, x; or
/// the next if that is constant in the plane.
std::size_t cross_axis(const Complex& complex, PlaneId plane, std::size_t axis);

/// All reflex edges of volumes with a label for which (label & 1) is set, with regard to walls along `axis`. O(n).
std::vector<ReflexEdge> reflex_edges(const Complex& complex, std::size_t axis, const Monitor& monitor);

/// Vertices that are alone inside such a volume. O(n).
std::vector<VertexId> lonely_vertices(const Complex& complex);

/// A corner at which a facet takes more than a half-turn, or a vertex alone inside a facet.
struct ReflexCorner {
  VertexId vertex{0};
  std::array<bool, 2> inside{};  ///< whether the facet goes on against / along the cut direction
};

/// The direction in which facets of this plane are cut; any that lies in the plane would do.
Direction cut_direction(const Complex& complex, PlaneId plane);

/// All reflex corners of one facet; none iff the facet is convex. O(size of the facet).
std::vector<ReflexCorner> reflex_corners(const Complex& complex, FacetId facet, const Monitor& monitor);

}  // namespace nef::minkowski
