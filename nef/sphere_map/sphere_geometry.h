// SPDX-License-Identifier: Apache-2.0
//
// Order on great circles and around svertices, and point location in a sphere map.
#pragma once

#include <cstdint>

#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// The direction of an svertex.
inline Direction direction_of(const PlaneTable& planes, const SVertex& svertex) {
  return Direction::cross(planes, svertex.p, svertex.q);
}

/// For three directions on the great circle of `plane`, x and t different from s: true if going
/// counterclockwise from s one meets x strictly before t. If `full` (t is s) every x qualifies.
bool strictly_between_on_circle(const PlaneTable& planes, PlaneId plane, const Direction& s, const Direction& x,
                                const Direction& t, bool full, const Monitor& monitor);

/// Compares two half-planes that leave the axis d, given by the normals of their oriented planes,
/// by their angle counterclockwise from the half-plane of `reference`: -1, 0, +1. The reference
/// itself comes first.
int compare_around(const Direction& d, const Direction& reference, const Direction& n1, const Direction& n2,
                   const Monitor& monitor);

/// A place on a sphere map.
struct SphereLocation {
  enum class Kind : std::uint8_t { kSVertex, kSHalfedge, kSLoop, kSFace };
  Kind kind = Kind::kSFace;
  std::uint32_t index = 0;
};

/// The item of the map that holds the direction. O(size of the map).
SphereLocation locate(const PlaneTable& planes, const SphereMapView& map, const Direction& direction,
                      const Monitor& monitor);

/// The wedge of svertex `s` (which must not be isolated) that holds the half-plane of `normal`:
/// the shalfedge that starts at s and has the wedge to its left. `on` tells whether the half-plane
/// runs along that shalfedge itself.
struct Wedge {
  std::uint32_t shalfedge = kNone;
  bool on = false;
};
Wedge locate_wedge(const PlaneTable& planes, const SphereMapView& map, std::uint32_t svertex, const Direction& normal,
                   const Monitor& monitor);

/// The mark of the item at a location.
LabelId mark_at(const SphereMapView& map, const SphereLocation& location);

}  // namespace nef
