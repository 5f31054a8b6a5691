// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull::bench {

/// What CGAL makes of the same cones.
struct PeerResult {
  double seconds = 0;  ///< of the intersections alone
  std::size_t vertices = 0;
  std::size_t facets = 0;
};

/// Intersects the cones of all views and the box one after the other with CGAL's Nef_polyhedron_3 over its
/// kernel of exact constructions. The cones are built before the clock starts.
PeerResult intersect_with_cgal(const std::vector<ViewResult>& views, const WorldBox& box);

}  // namespace nef::visual_hull::bench
