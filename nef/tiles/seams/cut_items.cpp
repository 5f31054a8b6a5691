// SPDX-License-Identifier: Apache-2.0
//
// A cut edge: of n facets around it, the map has n arcs from the edge's svertex to the circle of the wall, which they
// cut into n arcs, and nothing else. It is the same all along the edge if the centre looks like the edge, the ends of
// arcs on the circle like the arcs, and the arcs of the circle like the sfaces on their inner side. What both tiles
// have in the wall is the same; so if the edge goes on in its own direction, all does.
//
// A cut facet: its plane divides the region, which is a wedge or an octant there, into two sfaces.
#include "nef/tiles/seams/cut_items.h"

#include <algorithm>
#include <bit>

namespace nef {
namespace {

constexpr std::size_t kMost = 64;  // svertices

std::uint64_t bit(std::uint32_t svertex) { return std::uint64_t{1} << svertex; }

// The mark on the inner side of an arc of a wall, which must be its own, too.
std::optional<LabelId> inner_mark(const SphereMapView& map, std::uint32_t shalfedge) {
  const LabelId left = map.sfaces[map.shalfedges[shalfedge].sface].mark;
  const LabelId right = map.sfaces[map.shalfedges[shalfedge ^ 1U].sface].mark;
  if ((left == kOutside) == (right == kOutside)) return std::nullopt;
  const LabelId inner = left == kOutside ? right : left;
  if (map.shalfedges[shalfedge].mark != inner) return std::nullopt;
  return inner;
}

}  // namespace

std::optional<std::array<std::uint32_t, 2>> planes_of_cut_edge(const SphereMapView& map, std::uint32_t wall,
                                                               std::span<const std::uint32_t> rows) {
  const std::size_t size = map.svertices.size();
  if (size < 3 || size > kMost || !map.sloops.empty() || map.shalfedges.size() != 4 * (size - 1)) return std::nullopt;
  std::uint64_t on_circle = 0;
  std::size_t arcs_of_circle = 0;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const SHalfedge& half = map.shalfedges[e];
    if (rows[half.plane.row()] != wall) continue;
    ++arcs_of_circle;
    on_circle |= bit(half.source) | bit(map.target(e));
    if (!inner_mark(map, e)) return std::nullopt;
  }
  if (arcs_of_circle != size - 1 || static_cast<std::size_t>(std::popcount(on_circle)) != size - 1) return std::nullopt;
  const auto pole = static_cast<std::uint32_t>(std::countr_one(on_circle));
  if (map.svertices[pole].mark != map.mark) return std::nullopt;
  std::array<std::uint32_t, 2> smallest{kNone, kNone};
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const SHalfedge& half = map.shalfedges[e];
    const std::uint32_t row = rows[half.plane.row()];
    if (row == wall) continue;
    if (half.source != pole && map.target(e) != pole) return std::nullopt;
    const std::uint32_t end = half.source == pole ? map.target(e) : half.source;
    if (end == pole || map.svertices[end].mark != half.mark) return std::nullopt;
    if (row < smallest[0]) {
      smallest = {row, smallest[0]};
    } else if (row != smallest[0]) {
      smallest[1] = std::min(smallest[1], row);
    }
  }
  if (smallest[1] == kNone) return std::nullopt;
  return smallest;
}

std::optional<FacetInside> cut_facet(const SphereMapView& map, std::span<const std::uint32_t> walls,
                                     std::span<const std::uint32_t> rows) {
  if (map.sfaces.size() != 3 || !map.sloops.empty()) return std::nullopt;
  const auto in_wall = [&](std::uint32_t e) {
    return std::find(walls.begin(), walls.end(), rows[map.shalfedges[e].plane.row()]) != walls.end();
  };
  std::uint32_t arc = kNone;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    if (in_wall(e)) continue;
    if (arc != kNone) return std::nullopt;
    arc = e;
  }
  if (arc == kNone) return std::nullopt;
  arc ^= map.shalfedges[arc].plane.flipped() ? 1U : 0U;
  FacetInside facet;
  facet.row = rows[map.shalfedges[arc].plane.row()];
  facet.mark = map.shalfedges[arc].mark;
  facet.above = map.sfaces[map.shalfedges[arc].sface].mark;
  facet.below = map.sfaces[map.shalfedges[arc ^ 1U].sface].mark;
  if (facet.above == kOutside || facet.below == kOutside || map.mark != facet.mark) return std::nullopt;
  const std::array<std::uint32_t, 2> ends{map.shalfedges[arc].source, map.target(arc)};
  for (const std::uint32_t end : ends) {
    if (map.svertices[end].mark != facet.mark) return std::nullopt;
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    if (!in_wall(e)) continue;
    const std::optional<LabelId> mark = inner_mark(map, e);
    if (!mark) return std::nullopt;
    const std::uint32_t source = map.shalfedges[e].source;
    if (source != ends[0] && source != ends[1] && map.svertices[source].mark != *mark) return std::nullopt;
  }
  const bool bare =
      std::any_of(map.svertices.begin(), map.svertices.end(), [](const SVertex& s) { return s.out == kNone; });
  if (bare) return std::nullopt;
  return facet;
}

}  // namespace nef
