// SPDX-License-Identifier: Apache-2.0
//
// Back-projection: the solid of all points that a camera sees in a region of its image.
#pragma once

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/world_box.h"
#include "nef/forward.h"

namespace nef::visual_hull {

/// The range of depths of a box as a camera sees it.
struct DepthRange {
  Rational nearest, farthest;
};
DepthRange depth_range(const Camera& camera, const WorldBox& box);

/// A closed solid that agrees, within `box`, with the one-sided cone of the points whose image lies
/// in the silhouette (the prism, if the lines of sight are parallel); the camera's centre, where it lies in the box, is
/// its apex and belongs to it. Beyond the box the solid ends at planes of constant depth. Holes of the silhouette are
/// tunnels. Every plane through the apex comes straight from the matrix and two vertices, so
/// equal lines in equal cameras are the same plane. Empty if the silhouette is empty or the whole
/// box lies behind the camera. O(n log n) for n vertices.
nef::Polyhedron make_cone(const Camera& camera, const Silhouette& silhouette, const WorldBox& box,
                          const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
