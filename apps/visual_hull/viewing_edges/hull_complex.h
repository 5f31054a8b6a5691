// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/viewing_edges/crowded_vertex.h"
#include "apps/visual_hull/viewing_edges/edge_view.h"
#include "nef/forward.h"

namespace nef::visual_hull {

/// The vertices of a hull.
struct HullVertices {
  std::vector<SpotName> plain;  ///< each once, those that are close to each other in space as a rule close here, too
  std::vector<CrowdedVertex> crowded;  ///< by their points, each once
};

/// The closed solid with the given vertices. In a plain one exactly the planes of three edges meet: of three views,
/// or two neighbours in one silhouette (with those of rings that touch there) and one of another view. Nothing if a
/// corner is straight. `cameras` are those of the views. O(n log n); planes and vertices on the threads of `monitor`,
/// whose number does not change the result.
std::optional<nef::Polyhedron> complex_of(const HullVertices& vertices, const std::vector<ViewingEdge>& edges,
                                          const std::vector<const Camera*>& cameras, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
