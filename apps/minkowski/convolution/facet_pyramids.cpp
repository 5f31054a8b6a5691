// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/facet_pyramids.h"

#include <algorithm>

#include "apps/minkowski/cells/exact_cells.h"

namespace nef::minkowski {
namespace {

LabelId outside_mark(PlaneId plane) { return plane.flipped() ? kOutsideBelow : kOutsideAbove; }

}  // namespace

// The plane through a side and parallel to the axis of the projection, its positive side where the facet is.
PlaneId FacetPyramids::side_plane(std::uint32_t facet, std::uint32_t side) {
  PlaneId& plane = side_plane_[facets_.begin[facet] + side];
  if (plane.valid()) return plane;
  const auto ring = facets_.ring(facet);
  const PointId from{ring[side]};
  const PointId to{ring[side + 1 < ring.size() ? side + 1 : 0]};
  const auto [axis, sign] = projection_axis(facets_.planes, facets_.plane[facet]);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  std::array<Integer, 3> normal;
  const PointTable& points = facets_.points;
  const auto difference = [&](std::size_t i) {
    return Integer(Integer(points.coordinate(to, i)) * Integer(points.coordinate(from, 3)) -
                   Integer(points.coordinate(from, i)) * Integer(points.coordinate(to, 3)));
  };
  normal[u] = -sign * difference(v);
  normal[v] = sign * difference(u);
  return plane = plane_through(facets_.planes, points, normal, from);
}

bool FacetPyramids::locate(std::uint32_t facet, PointId point, FacetAtPoint& result) {
  const Vector& x = facets_.points.approximate(point);
  const RoundedFace& plane = rounded_.plane(facet);
  const double value = plane.value(x);
  if (value > plane.slack || value < -plane.slack) return false;
  const std::span<const RoundedSide> sides = rounded_.sides(facet);
  result = {facet, {}};
  std::uint64_t doubtful = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double inside = sides[i].value(x);
    const double doubt = sides[i].slack + sides[i].weight * rounded_.corner_error();
    if (inside < -doubt) return false;
    if (!(inside > doubt)) doubtful |= std::uint64_t{1} << std::min<std::size_t>(i, 63);
  }
  if (side_of_plane(facets_.planes, facets_.plane[facet], facets_.points, point) != 0) return false;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    if ((doubtful >> std::min(i, 63U) & 1U) == 0) continue;
    const PlaneId side = side_plane(facet, i);
    const int sign = side_of_plane(facets_.planes, side, facets_.points, point);
    if (sign < 0) return false;
    if (sign > 0 || side == result.sides[0] || side == result.sides[1]) continue;
    result.sides[result.sides[0].valid() ? 1 : 0] = side;
  }
  return true;
}

const std::vector<FacetAtPoint>& FacetPyramids::facets_at(PointId point) {
  Box box;
  box.add_rounded(facets_.points.approximate(point));
  found_.clear();
  FacetAtPoint at;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (locate(f, point, at)) found_.push_back(at);
  });
  return found_;
}

// With its inside to the left, the side of a plane S runs along n_S x n_P. At a corner the facet goes counterclockwise
// from the side that leaves to the one that arrives, backwards.
void FacetPyramids::draw_facet(const FacetAtPoint& at, SphereMapBuffer& out) {
  const PlaneId plane = facets_.plane[at.facet];
  const LabelId mark = outside_mark(plane);
  const PlaneTable& planes = facets_.planes;
  if (!at.sides[0].valid()) {
    out.assign_circle(plane, mark, 0, 0);
    out.mark = mark;
    return;
  }
  PlaneId leaving = at.sides[0];
  PlaneId arriving = at.sides[1].valid() ? at.sides[1] : leaving;
  if (at.sides[1].valid() && orientation_on_circle(planes, plane, Direction::cross(planes, arriving, plane),
                                                   Direction::cross(planes, leaving, plane)) < 0) {
    std::swap(leaving, arriving);
  }
  drawing_.clear();
  drawing_.centre = mark;
  drawing_.nodes.resize(2);
  drawing_.nodes[0].direction = Direction::cross(planes, leaving, plane);
  drawing_.nodes[1].direction = Direction::cross(planes, plane, arriving);
  drawing_.nodes[0].mark = drawing_.nodes[1].mark = mark;
  drawing_.arcs.push_back({plane, 0, 1, mark, 0, 0});
  drawing_.sort_around_nodes(planes);
  drawing_.simplify_and_assemble(planes, out);
}

SphereMapBuffer FacetPyramids::draw(const std::vector<FacetAtPoint>& at) {
  SphereMapBuffer* map = &maps_[0];
  SphereMapBuffer* next = &maps_[1];
  std::vector<PlaneId> whole;  // planes whose circle is there
  for (const FacetAtPoint& f : at) {
    const PlaneId plane = facets_.plane[f.facet];
    if (!f.sides[0].valid() && std::find(whole.begin(), whole.end(), plane) == whole.end()) whole.push_back(plane);
  }
  bool first = true;
  const auto add = [&] {
    if (first) {
      std::swap(*map, maps_[2]);
    } else {
      overlay_.overlay(facets_.planes, map->view(), maps_[2].view(), or_, *next);
      std::swap(map, next);
    }
    first = false;
  };
  for (const PlaneId plane : whole) {
    maps_[2].assign_circle(plane, outside_mark(plane), 0, 0);
    add();
  }
  for (const FacetAtPoint& f : at) {
    if (std::find(whole.begin(), whole.end(), facets_.plane[f.facet]) != whole.end()) continue;
    draw_facet(f, maps_[2]);
    add();
  }
  return *map;
}

bool FacetPyramids::sees(PointId from, PointId to, const std::vector<FacetAtPoint>& except) {
  const PlaneTable& planes = facets_.planes;
  const PointTable& points = facets_.points;
  Box box;
  box.add_rounded(points.approximate(from));
  box.add_rounded(points.approximate(to));
  bool clear = true;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (!clear || std::any_of(except.begin(), except.end(), [f](const FacetAtPoint& e) { return e.facet == f; }))
      return;
    const int side = side_of_plane(planes, facets_.plane[f], points, from);
    if (side != 0 && side_of_plane(planes, facets_.plane[f], points, to) == side) return;
    for (std::uint32_t i = 0; i < facets_.ring(f).size(); ++i) {
      const PlaneId across = side_plane(f, i);
      if (side_of_plane(planes, across, points, from) < 0 && side_of_plane(planes, across, points, to) < 0) return;
    }
    clear = false;
  });
  return clear;
}

}  // namespace nef::minkowski
