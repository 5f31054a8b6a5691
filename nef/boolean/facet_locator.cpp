// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/facet_locator.h"

#include <cmath>

namespace nef {
namespace {

// What rays from points of the box toward smaller values of the plane's first axis meet. Along a ray the third
// coordinate follows the plane.
Box with_rays(Box box, const PlaneAxes& axes) {
  const auto third = static_cast<std::size_t>(3 - axes.first - axes.second);
  box.low[static_cast<std::size_t>(axes.first)] = -HUGE_VAL;
  box.low[third] = -HUGE_VAL;
  box.high[third] = HUGE_VAL;
  return box;
}

}  // namespace

void FacetLocator::expect(std::span<const FacetId> facets) {
  for (const FacetId facet : facets) {
    if (corners_of(facet).size() > kSmall) trees_.try_emplace(facet);
  }
}

const FacetLocator::LazyTree& FacetLocator::tree(FacetId facet) const {
  LazyTree& entry = trees_.at(facet);
  std::call_once(entry.once, [&] {
    const Box asked = with_rays(other_.bounds(), PlaneAxes(tables_.planes, operand_.facet_plane(facet)));
    std::vector<Box> boxes;
    for (const SHalfedgeId corner : corners_of(facet)) {
      const HalfedgeId halfedge = operand_.complex().corner_halfedge(corner);
      const Box box = operand_.edge_box(halfedge);
      if (!box.overlaps(asked)) continue;
      boxes.push_back(box);
      entry.halfedges.push_back(halfedge);
    }
    entry.tree = BoxTree(boxes);
  });
  return entry;
}

ItemRef FacetLocator::locate(FacetId facet, PointId point, const Monitor& monitor) const {
  const PlaneTable& planes = tables_.planes;
  const PointTable& points = tables_.points;
  const PlaneId plane = operand_.facet_plane(facet);
  const PlaneAxes axes(planes, plane);
  Box at;
  at.add_rounded(points.approximate(point));
  const Box ray = with_rays(at, axes);
  ItemRef found;
  bool inside = false;
  for_each_edge(facet, ray, [&](HalfedgeId halfedge) {
    if (found.valid()) return;
    const VertexId a = operand_.source(halfedge);
    const VertexId b = operand_.target(halfedge);
    const int a_height = compare_coordinate(points, operand_.point(a), point, axes.second, monitor);
    const int b_height = compare_coordinate(points, operand_.point(b), point, axes.second, monitor);
    if (a_height * b_height > 0) return;
    if (a_height == 0 && compare_coordinate(points, operand_.point(a), point, axes.first, monitor) == 0) {
      found = ItemRef(a);
      return;
    }
    if (b_height == 0 && compare_coordinate(points, operand_.point(b), point, axes.first, monitor) == 0) {
      found = ItemRef(b);
      return;
    }
    if (a_height == 0 && b_height == 0) {
      if (compare_coordinate(points, operand_.point(a), point, axes.first, monitor) !=
          compare_coordinate(points, operand_.point(b), point, axes.first, monitor)) {
        found = ItemRef(operand_.edge(halfedge));
      }
      return;
    }
    const EdgeSide edge = operand_.edge_side(planes, plane, halfedge, monitor);
    const int side = edge.left * side_of_plane(planes, edge.other, points, point, monitor);
    if (side == 0) {
      // On the line, and strictly between the ends in height.
      if (a_height * b_height < 0) found = ItemRef(operand_.edge(halfedge));
      return;
    }
    // The ray runs a hair above the point: ends at its height count as below. An edge that rises
    // has smaller values to its left.
    const bool rises = b_height > 0;
    if (rises == (a_height > 0)) return;
    const int left = axes.positive ? side : -side;
    if ((rises && left < 0) || (!rises && left > 0)) inside = !inside;
  });
  if (found.valid() || !inside) return found;
  const Facet& f = operand_.complex().facets[facet];
  for (const VertexId v : operand_.complex().isolated_vertices_of(f)) {
    if (compare_coordinate(points, operand_.point(v), point, axes.first, monitor) == 0 &&
        compare_coordinate(points, operand_.point(v), point, axes.second, monitor) == 0) {
      return ItemRef(v);
    }
  }
  return ItemRef(facet);
}

}  // namespace nef
