// SPDX-License-Identifier: Apache-2.0
//
// Edges and facets in trees of boxes, vertices in classes of those that edges connect, planes by their normals.
#include "nef/distance/meeting_sets.h"

#include <cmath>

#include "nef/base/union_find.h"
#include "nef/complex/item_boxes.h"
#include "nef/location/facet_search.h"

namespace nef {
namespace {

// The planes of a complex, moved to the origin, in a common table: equal where normals are.
std::vector<PlaneId> intern_normals(const PlaneTable& from, PlaneTable& to) {
  std::vector<PlaneId> result;
  for (std::uint32_t row = 0; row < from.size(); ++row) {
    const PlaneId plane = PlaneId::of_row(row);
    result.push_back(to.intern(Integer(from.coefficient(plane, 0)), Integer(from.coefficient(plane, 1)),
                               Integer(from.coefficient(plane, 2)), Integer(0)));
  }
  return result;
}

}  // namespace

Box shifted(const Box& box, const std::array<double, 3>& by) {
  Box result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = box.low[i] + by[i];
    const double high = box.high[i] + by[i];
    const double slack = (std::fabs(box.low[i]) + std::fabs(box.high[i]) + std::fabs(by[i])) * 0x1p-50 + 1e-300;
    const bool known = slack < HUGE_VAL;
    result.low[i] = known ? low - slack : -HUGE_VAL;
    result.high[i] = known ? high + slack : HUGE_VAL;
  }
  return result;
}

MeetingSide::MeetingSide(const Polyhedron& of) : set(of), c(set.complex()), points(c.points.rationals()) {
  std::vector<Box> boxes;
  UnionFind connected(c.vertex_count());
  for (const HalfedgeId h : c.halfedge_ids()) {
    if (h > c.twin[h]) continue;
    edges.push_back({h, c.source(h), c.target(h)});
    connected.unite(c.source(h).index(), c.target(h).index());
    boxes.push_back(edge_box(c, h));
  }
  edge_tree = BoxTree(boxes);
  rough_edges = edge_tree.rough();
  boxes.clear();
  for (const Facet& facet : c.facets) {
    boxes.push_back(facet_box(c, facet));
    constexpr std::size_t kMany = 64;
    if (c.corners_of(facet).size() >= kMany) trees.emplace(boxes.size() - 1, facet_edge_tree(c, facet));
  }
  facet_tree = BoxTree(boxes);
  rough_facets = facet_tree.rough();
  bounds = vertices_box(c);
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) {
    part.push_back(connected.find(v));
    if (part.back() == v) parts.push_back(v);
  }
  for (const HalfedgeId h : c.bare_edges()) bare.push_back({h, c.source(h), c.target(h)});
  filter.emplace(c, points);
}

MeetingSets::MeetingSets(const Polyhedron& of_a, const Polyhedron& of_b) : sets{of_a, of_b} {
  if (of_a.is_empty() || of_b.is_empty() || !of_a.is_bounded() || !of_b.is_bounded()) return;
  for (const Polyhedron& set : sets) {
    sides.push_back(std::make_unique<MeetingSide>(set));
    normals.push_back(intern_normals(set.complex().planes, planes));
  }
}

}  // namespace nef
