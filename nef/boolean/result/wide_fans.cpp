// SPDX-License-Identifier: Apache-2.0
//
// A ray from a vertex into a facet leaves the facet through a side that does not end at the vertex, or along a side to
// its other end. So the sides of the outer cycle that do not end at a vertex of the facet are seen from there in all
// directions in which the facet is seen.
#include "nef/boolean/result/wide_fans.h"

#include <algorithm>
#include <array>

namespace nef {
namespace {

// Facets around a vertex whose pairs with as many edges take longer than a tree.
constexpr std::size_t kWide = 64;
// Sides of a facet that are looked at one by one.
constexpr std::size_t kManySides = 24;

// Calls visit(segment) for the sides of the outer cycle that do not end at a vertex, while it returns true.
template <typename Visit>
bool each_far_side(const Complex& c, const Facet& facet, VertexId centre, const Visit& visit) {
  for (const SHalfedgeId corner : c.corners_of(facet.first_cycle)) {
    const VertexId u = c.shalfedge_vertex(corner);
    const VertexId v = c.target(c.corner_halfedge(corner));
    if (u == centre || v == centre) continue;
    if (!visit(std::array{c.points.approximate(point_of(u)), c.points.approximate(point_of(v))})) return false;
  }
  return true;
}

}  // namespace

WideFans::WideFans(const Operand& operand, std::span<const FacetId> facets) {
  const Complex& c = operand.complex();
  const auto is_wide = [&](VertexId v) { return c.halfedges(v).size() >= kWide; };
  const auto ids = c.vertex_ids();
  if (std::none_of(ids.begin(), ids.end(), is_wide)) return;
  IndexedVector<VertexId, std::uint32_t> fan_at(c.vertex_count(), kNone);
  boxes_.reserve(facets.size());
  for (std::uint32_t place = 0; place < facets.size(); ++place) {
    const Facet facet = c.facets[facets[place]];
    boxes_.push_back(operand.facet_box(facets[place]));
    VertexId centre;
    const std::span<const SHalfedgeId> corners = c.corners_of(facet.first_cycle);
    for (const SHalfedgeId corner : corners) {
      const VertexId v = c.shalfedge_vertex(corner);
      if (!is_wide(v) || corners.size() > kManySides) continue;
      if (!centre.valid() || c.halfedges(v).size() > c.halfedges(centre).size()) centre = v;
    }
    if (centre.valid()) {
      if (fan_at[centre] == kNone) {
        fan_at[centre] = static_cast<std::uint32_t>(fans_.size());
        fans_.push_back({centre, {}, {}, DirectionTree(c.points.approximate(point_of(centre)), 0)});
      }
      if (join(operand, facets[place], place, fans_[fan_at[centre]])) continue;
    }
    plain_.push_back(place);
  }
  for (Fan& fan : fans_) fan.directions.build();
  std::vector<Box> boxes;
  for (const std::uint32_t place : plain_) boxes.push_back(boxes_[place]);
  plain_tree_ = BoxTree(boxes);
}

bool WideFans::join(const Operand& operand, FacetId id, std::uint32_t place, Fan& fan) {
  const Complex& c = operand.complex();
  const Facet facet = c.facets[id];
  const auto sees = [&](std::span<const Double3> side) { return fan.directions.sees(side); };
  if (!each_far_side(c, facet, fan.centre, sees)) return false;
  each_far_side(c, facet, fan.centre, [&](std::span<const Double3> side) { return fan.directions.add(place, side); });
  fan.places.push_back(place);
  fan.box.add(boxes_[place]);
  return true;
}

void WideFans::find(std::span<const Double3> ends, std::span<const VertexId> end_at, const Box& box,
                    std::vector<std::uint32_t>& places) const {
  plain_tree_.for_each_overlap(box, [&](std::uint32_t i) { places.push_back(plain_[i]); });
  std::vector<std::uint32_t> found;
  std::vector<Double3> others;
  for (const Fan& fan : fans_) {
    if (!fan.box.overlaps(box)) continue;
    found.clear();
    others.clear();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (end_at[i] != fan.centre) others.push_back(ends[i]);
    }
    const bool told = fan.directions.find(others, found);
    for (const std::uint32_t place : told ? found : fan.places) {
      if (boxes_[place].overlaps(box)) places.push_back(place);
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

}  // namespace nef
