// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/direct_hull.h"

#include <algorithm>
#include <atomic>

#include "apps/visual_hull/viewing_edges/corners.h"
#include "apps/visual_hull/viewing_edges/hull_complex.h"
#include "apps/visual_hull/viewing_edges/space_halving.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/threads/shared_out.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

using FacetLine = std::uint64_t;  // of the planes of two edges

FacetLine facet_line(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b); }

// The lines of the hull's edges that end in a plain vertex.
template <typename Take>
void each_line(const SpotName& name, const std::vector<ViewingEdge>& edges, const Take& take) {
  const std::optional<std::uint32_t> corner = corner_of(name, edges);
  if (!corner) {
    for (std::size_t i = 0; i < 3; ++i) take(facet_line(name[i], name[(i + 1) % 3]));
    return;
  }
  const std::uint32_t in = edges[*corner].previous;
  const std::uint32_t across = name[0] ^ name[1] ^ name[2] ^ *corner ^ in;
  take(facet_line(in, *corner));
  for (std::uint32_t out = *corner; out != UINT32_MAX; out = edges[out].next_at_place) {
    take(facet_line(out, across));
    take(facet_line(edges[out].previous, across));
  }
}

bool lines_pair_up(std::vector<FacetLine>& lines, const std::vector<CrowdedVertex>& crowded) {
  std::sort(lines.begin(), lines.end());
  const auto passes = [](const CrowdedVertex& vertex, FacetLine line) {
    const auto there = [&](FacetLine e) { return std::binary_search(vertex.edges.begin(), vertex.edges.end(), e); };
    return there(line >> 32U) && there(line & UINT32_MAX);
  };
  for (auto line = lines.begin(); line != lines.end();) {
    const auto end = std::find_if(line, lines.end(), [&](FacetLine other) { return other != *line; });
    const bool odd = (end - line) % 2 != 0;
    if (odd && std::none_of(crowded.begin(), crowded.end(),
                            [&](const CrowdedVertex& vertex) { return passes(vertex, *line); })) {
      return false;
    }
    line = end;
  }
  return true;
}

// Every edge of the hull has two ends, so a line with an odd number of plain vertices passes a crowded one, too:
// otherwise a vertex was lost.
bool ends_pair_up(const HullVertices& vertices, const std::vector<ViewingEdge>& edges, const nef::Monitor& monitor) {
  auto lines = nef::shared_out<FacetLine>(vertices.plain.size(), monitor, [&](std::size_t i, const auto& put) {
    each_line(vertices.plain[i], edges, [&put](FacetLine line) { put((line >> 32U) % nef::kShares, line); });
  });
  std::atomic<bool> paired = true;
  nef::parallel_for(nef::kShares, monitor, [&](std::size_t share, const nef::Monitor&) {
    if (!lines_pair_up(lines[share], vertices.crowded)) paired = false;
  });
  return paired;
}

}  // namespace

std::optional<nef::Polyhedron> direct_hull(const std::vector<DirectView>& views, const WorldBox& box,
                                           const nef::Monitor& monitor) {
  if (views.size() < 3) return std::nullopt;
  const std::unique_ptr<const EdgeScene> scene = EdgeScene::make(views, box, monitor);
  if (!scene) return std::nullopt;
  const std::optional<HullVertices> vertices = hull_vertices(*scene, monitor);
  if (!vertices || !ends_pair_up(*vertices, scene->edges, monitor)) return std::nullopt;
  std::vector<const Camera*> cameras;
  for (const DirectView& input : views) cameras.push_back(input.camera);
  return complex_of(*vertices, scene->edges, cameras, monitor);
}

}  // namespace nef::visual_hull
