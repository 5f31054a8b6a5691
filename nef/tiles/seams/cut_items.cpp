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
#include <array>
#include <bit>

namespace nef {
namespace {

constexpr std::size_t kMost = 64;  // svertices, or pairs of shalfedges

std::uint64_t bit(std::uint32_t item) { return std::uint64_t{1} << item; }

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

std::uint64_t facets_of_cut_edge(const SphereMapView& pattern, std::uint64_t in_wall) {
  const std::size_t size = pattern.svertices.size();
  if (size < 3 || size > kMost || !pattern.sloops.empty() || pattern.shalfedges.size() != 4 * (size - 1)) return 0;
  if (pattern.shalfedges.size() > 2 * kMost || static_cast<std::size_t>(std::popcount(in_wall)) != size - 1) return 0;
  std::uint64_t on_circle = 0;
  for (std::uint32_t e = 0; e < pattern.shalfedges.size(); e += 2) {
    if ((in_wall & bit(e / 2)) == 0) continue;
    on_circle |= bit(pattern.shalfedges[e].source) | bit(pattern.target(e));
    if (!inner_mark(pattern, e)) return 0;
  }
  if (static_cast<std::size_t>(std::popcount(on_circle)) != size - 1) return 0;
  const auto pole = static_cast<std::uint32_t>(std::countr_one(on_circle));
  if (pattern.svertices[pole].mark != pattern.mark) return 0;
  std::uint64_t facets = 0;
  for (std::uint32_t e = 0; e < pattern.shalfedges.size(); e += 2) {
    if ((in_wall & bit(e / 2)) != 0) continue;
    const std::uint32_t source = pattern.shalfedges[e].source;
    const std::uint32_t target = pattern.target(e);
    if (source != pole && target != pole) return 0;
    const std::uint32_t end = source == pole ? target : source;
    if (end == pole || pattern.svertices[end].mark != pattern.shalfedges[e].mark) return 0;
    facets |= bit(e / 2);
  }
  return facets;
}

std::optional<CutFacet> cut_facet(const SphereMapView& pattern, std::uint64_t in_wall) {
  if (pattern.sfaces.size() != 3 || !pattern.sloops.empty() || pattern.shalfedges.size() > 2 * kMost) {
    return std::nullopt;
  }
  CutFacet facet;
  std::size_t arcs = 0;
  for (std::uint32_t e = 0; e < pattern.shalfedges.size(); e += 2) {
    if ((in_wall & bit(e / 2)) != 0) continue;
    facet.shalfedge = e;
    ++arcs;
  }
  if (arcs != 1) return std::nullopt;
  const SHalfedge arc = pattern.shalfedges[facet.shalfedge];
  facet.mark = arc.mark;
  facet.left = pattern.sfaces[arc.sface].mark;
  facet.right = pattern.sfaces[pattern.shalfedges[facet.shalfedge ^ 1U].sface].mark;
  if (facet.left == kOutside || facet.right == kOutside || pattern.mark != facet.mark) return std::nullopt;
  const std::array<std::uint32_t, 2> ends{arc.source, pattern.target(facet.shalfedge)};
  for (const std::uint32_t end : ends) {
    if (pattern.svertices[end].mark != facet.mark) return std::nullopt;
  }
  for (std::uint32_t e = 0; e < pattern.shalfedges.size(); ++e) {
    if ((in_wall & bit(e / 2)) == 0) continue;
    const std::optional<LabelId> mark = inner_mark(pattern, e);
    if (!mark) return std::nullopt;
    const std::uint32_t source = pattern.shalfedges[e].source;
    if (source != ends[0] && source != ends[1] && pattern.svertices[source].mark != *mark) return std::nullopt;
  }
  const bool bare =
      std::any_of(pattern.svertices.begin(), pattern.svertices.end(), [](const SVertex& s) { return s.out == kNone; });
  if (bare) return std::nullopt;
  return facet;
}

}  // namespace nef
