// SPDX-License-Identifier: Apache-2.0
//
// Checks of a hull against the silhouettes it comes from, by projection: nothing of how the hull
// was made is used.
#pragma once

#include <vector>

#include "apps/visual_hull/scene/camera.h"
#include "nef/forward.h"

namespace nef::visual_hull {

struct Verification {
  bool inside = false;         ///< exact: the hull's projection lies in the silhouette
  std::string problem;         ///< where it does not
  double difference_area = 0;  ///< of the silhouette minus the hull's projection and vice versa, in square pixels
  double silhouette_area = 0;
  bool area_known = true;  ///< not where the view keeps space beyond its frame
};

/// Scan lines of verify_view.
inline constexpr int kLinesPerPixel = 4;

/// Verifies a bounded, closed hull against one view.
/// `inside` is exact: (1) no vertex lies behind the camera, (2) no point of an edge's projection lies
/// outside the silhouette, (3) no hole of the silhouette is covered by a facet, which after (2) is
/// so iff the line of sight through a point of the hole meets the hull (a ray is shot). The
/// apex itself, where it is a vertex of the hull, has no projection and is passed over.
/// The area is an integral over scan lines, `lines_per_pixel` of them, exact along each
/// line but for rounding. O(edges log n) on ordinary input.
Verification verify_view(const nef::Polyhedron& hull, const Camera& camera, const Silhouette& silhouette,
                         int lines_per_pixel = kLinesPerPixel, const nef::Monitor& monitor = {});

/// The projection of the boundary cycles of each facet, for drawing: per facet its cycles of (u, v).
/// Facets seen edge-on, and those with a vertex that is not in front of the camera, are left out.
std::vector<std::vector<std::vector<std::array<double, 2>>>> project_facets(const nef::Polyhedron& hull,
                                                                            const Camera& camera);

}  // namespace nef::visual_hull
