// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/corners.h"

#include <algorithm>

namespace nef::visual_hull {

std::optional<std::uint32_t> corner_of(const SpotName& name, std::span<const ViewingEdge> edges) {
  for (const std::uint32_t out : name) {
    for (const std::uint32_t in : name) {
      if (edges[out].previous == in) return out;
    }
  }
  return std::nullopt;
}

std::uint32_t next_incoming(std::uint32_t out, std::span<const std::uint32_t> incoming,
                            std::span<const ViewingEdge> edges, const nef::Monitor& monitor) {
  const Point2& centre = *edges[out].from;
  const Point2& start = *edges[out].to;
  // Turning left from `start`, a comes before b.
  const auto before = [&](std::uint32_t in_a, std::uint32_t in_b) {
    const Point2& a = *edges[in_a].from;
    const Point2& b = *edges[in_b].from;
    const int ta = orientation(centre, start, a, monitor);
    const int tb = orientation(centre, start, b, monitor);
    const bool first_a = ta > 0;  // in the first half turn; nothing lies in the direction of `start` itself
    const bool first_b = tb > 0;
    if (first_a != first_b) return first_a;
    if (ta == 0 || tb == 0) return !first_a && ta == 0 && tb != 0;
    return orientation(centre, a, b, monitor) > 0;
  };
  return *std::min_element(incoming.begin(), incoming.end(), before);
}

}  // namespace nef::visual_hull
