// SPDX-License-Identifier: Apache-2.0
//
// The direct way to the hull: its vertices one by one, without intermediate solids. As in [Franco, Boyer 2003] they are
// ends of viewing edges (parts of the edges of cones) and points of three cones; here they come from halving space.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/cones/cone.h"

namespace nef::visual_hull {

/// One view of the direct way.
struct DirectView {
  const Camera* camera = nullptr;
  const Silhouette* silhouette = nullptr;
};

/// The intersection of the views' one-sided cones, which must lie in the interior of `box` (bounds_of with loosen gives
/// such a box). Nothing if there are fewer than three views, a camera does not have all of the box in front, or exact
/// answers pile up: the general way (intersect_parts) is for these. Space is halved until few facets pass a part
/// (hull_vertices); the vertices there are points of three facets that all silhouettes show (PartVertices), with
/// doubles whose errors are proven and integers where these do not decide. They are then written down as a complex
/// (complex_of); a vertex on more planes is an overlay of sphere maps. About O(n log n) for n places where facets come
/// near the surface of the hull. On the threads of `monitor`.
std::optional<nef::Polyhedron> direct_hull(const std::vector<DirectView>& views, const WorldBox& box,
                                           const nef::Monitor& monitor);

}  // namespace nef::visual_hull
