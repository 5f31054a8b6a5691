// SPDX-License-Identifier: Apache-2.0
//
// The direct way to the hull: its vertices one by one, without intermediate solids, along its viewing edges (parts of
// the edges of cones) and the edges between two cones [Franco, Boyer 2003], whose candidates come from halving space.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/cones/cone.h"

namespace visual_hull {

/// One view of the direct way.
struct DirectView {
  const Camera* camera = nullptr;
  const Silhouette* silhouette = nullptr;
};

/// The intersection of the views' one-sided cones, which must lie in the interior of `box` (bounds_of with loosen gives
/// such a box). Nothing if the views are in a degenerate position (cameras whose cones share planes, four planes
/// through a point, rings that touch) or a camera does not have all of the box in front: the general way
/// (intersect_parts) is for these. Every edge of the hull lies on an edge of a cone, or in two facets of different
/// cones. Candidates for the latter come from halving space (facet_pairs); each is cut by the
/// silhouettes of all other views in their images, with doubles whose errors are proven and rationals where these do
/// not decide. The vertices are then written down as a complex: three planes meet in each. Every vertex must have been
/// found by its three edges. About O(n log n + h views) for n polygon vertices and h edges of the hull. Uses up to
/// `threads` threads; the result does not depend on their number.
std::optional<nef::Polyhedron> direct_hull(const std::vector<DirectView>& views, const WorldBox& box, unsigned threads);

}  // namespace visual_hull
