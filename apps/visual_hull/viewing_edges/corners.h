// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_view.h"

namespace nef::visual_hull {

/// The edge that starts at the vertex of a silhouette on whose ray the named point lies; nothing if three views meet
/// there.
std::optional<std::uint32_t> corner_of(const SpotName& name, std::span<const ViewingEdge> edges);

/// At a vertex where rings may touch: the one of the edges `incoming`, which all end there, at which the region to the
/// left of an edge that starts there ends. Exact.
std::uint32_t next_incoming(std::uint32_t out, std::span<const std::uint32_t> incoming,
                            std::span<const ViewingEdge> edges, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
