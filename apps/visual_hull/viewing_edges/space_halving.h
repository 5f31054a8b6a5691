// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_scene.h"
#include "apps/visual_hull/viewing_edges/hull_complex.h"

namespace nef::visual_hull {

/// All vertices of the hull, and crowded points that may be none; nothing where PartVertices finds none. Space is
/// halved again and again; a part that a silhouette does not show at all is dropped, the edges of a silhouette that are
/// not seen in a part are dropped there, and a part that few facets pass gives its vertices. About O(s log s) for s
/// places where facets come near the surface of the hull, whatever the number of views is. On the threads of
/// `monitor`.
std::optional<HullVertices> hull_vertices(const EdgeScene& scene, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
