// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_view.h"
#include "nef/polyhedron.h"

namespace visual_hull {

/// The edge that starts at the vertex of a silhouette on whose ray the named point lies; nothing if three views meet
/// there.
std::optional<std::uint32_t> corner_of(const SpotName& name, const std::vector<ViewingEdge>& edges);

/// The closed solid with the given vertices, in each of which exactly the planes of three edges meet: of three views,
/// or two neighbours in one silhouette (with those of rings that touch there) and one of another view. Nothing if a
/// corner is straight. `cameras` are those of the views. O(n log n).
std::optional<nef::Polyhedron> complex_of(const std::vector<SpotName>& vertices, const std::vector<ViewingEdge>& edges,
                                          const std::vector<const Camera*>& cameras);

}  // namespace visual_hull
