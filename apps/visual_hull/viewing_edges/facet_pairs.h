// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_scene.h"

namespace visual_hull {

/// Pairs of edges of different views, the smaller number first, by that number, each once.
using FacetPairs = std::vector<std::array<std::uint32_t, 2>>;

/// All pairs of edges in whose two facets an edge of the hull can lie, and some more. Space is halved again and again;
/// a part that a silhouette does not show at all is dropped, the edges of a silhouette that are not seen in a part are
/// dropped there, and a part that few facets pass gives their pairs. Doubles with slack far above their roundings, so
/// that no pair is missed. About O(s log s) for s places where facets come near the surface of the hull. Uses up to
/// `threads` threads; the result does not depend on their number.
FacetPairs facet_pairs(const EdgeScene& scene, unsigned threads);

}  // namespace visual_hull
