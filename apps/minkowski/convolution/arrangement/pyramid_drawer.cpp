// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/geometry/compare_points.h"

namespace nef::minkowski {
namespace {

LabelId outside_mark(PlaneId plane) { return plane.flipped() ? kOutsideBelow : kOutsideAbove; }

}  // namespace

LabelId PyramidDrawer::label(std::uint8_t in_sum) const {
  const bool is_in = facets_.marks == BoundaryMarks::kMixed ? in_sum != 0 : facets_.marks == BoundaryMarks::kAll;
  return is_in ? kInSum : LabelId{0};
}

// Of the sides of a facet at a point of its border, and of the point.
PyramidDrawer::BorderLabels PyramidDrawer::border_labels(std::uint32_t facet, const PointTable& points,
                                                         PointId point) const {
  if (facets_.marks != BoundaryMarks::kMixed) return {label(0), label(0), label(0)};
  const auto ring = facets_.ring(facet);
  const std::uint32_t begin = facets_.begin[facet];
  const auto order = [&](std::uint32_t corner, int axis) {
    return compare_coordinate(points, point, facets_.points, PointId{ring[corner]}, axis, monitor_);
  };
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (order(i, 0) != 0 || order(i, 1) != 0 || order(i, 2) != 0) continue;
    const std::uint32_t before = i > 0 ? i - 1 : static_cast<std::uint32_t>(ring.size()) - 1;
    return {label(facets_.side_marks[begin + i]), label(facets_.side_marks[begin + before]),
            label(facets_.corner_marks[begin + i])};
  }
  // On the line of a side that is between its ends in every coordinate.
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t next = i + 1 < ring.size() ? i + 1 : 0;
    bool between = true;
    for (int axis = 0; axis < 3 && between; ++axis) between = order(i, axis) * order(next, axis) <= 0;
    if (!between || !is_on_side(facet, i, points, point)) continue;
    const LabelId mark = label(facets_.side_marks[begin + i]);
    return {mark, mark, mark};
  }
  NEF_ASSERT(false);  // the point is on the border
  return {};
}

bool PyramidDrawer::is_on_side(std::uint32_t facet, std::uint32_t side, const PointTable& points, PointId point) const {
  return side_of_plane(facets_.planes, pyramids_.side_plane(facet, side), points, point, monitor_) == 0;
}

bool PyramidDrawer::is_void(std::uint32_t facet) const {
  if (facets_.marks != BoundaryMarks::kMixed) return true;  // all facets have the same marks
  if (facets_.inside_marks[facet] != 0) return false;
  for (std::uint32_t i = facets_.begin[facet]; i < facets_.begin[facet + 1]; ++i) {
    if ((facets_.side_marks[i] | facets_.corner_marks[i]) != 0) return false;
  }
  return true;
}

// With its inside to the left, the side of a plane S runs along n_S x n_P. At a corner the facet goes counterclockwise
// from the side that leaves to the one that arrives, backwards.
void PyramidDrawer::draw_facet(const FacetAtPoint& at, const PointTable& points, PointId point) {
  const PlaneId plane = facets_.plane[at.facet];
  const LabelId bits = outside_mark(plane);
  const std::uint8_t inside = facets_.marks == BoundaryMarks::kMixed ? facets_.inside_marks[at.facet] : 0;
  const PlaneTable& planes = facets_.planes;
  const bool is_corner = at.sides[1].valid();
  std::size_t leaving = 0;
  std::size_t arriving = is_corner ? 1 : 0;
  if (is_corner && orientation_on_circle(planes, plane, Direction::cross(planes, at.sides[arriving], plane),
                                         Direction::cross(planes, at.sides[leaving], plane), monitor_) < 0) {
    std::swap(leaving, arriving);
  }
  const BorderLabels border = border_labels(at.facet, points, point);
  centre_ |= bits | border.centre;
  const DrawnArcs::End source = {Direction::cross(planes, at.sides[leaving], plane),
                                 static_cast<LabelId>(bits | border.leaving), key_along(at, leaving, true)};
  const DrawnArcs::End target = {Direction::cross(planes, plane, at.sides[arriving]),
                                 static_cast<LabelId>(bits | border.arriving), key_along(at, arriving, false)};
  arcs_.add_arc(plane, source, target, static_cast<LabelId>(bits | label(inside)));
}

// The direction of a side, from its first corner to its second one or back, as a number: that of these corners. Facets
// that share a side have its corners in common.
std::uint64_t PyramidDrawer::key_along(const FacetAtPoint& at, std::size_t side, bool forward) const {
  const auto ring = facets_.ring(at.facet);
  const std::uint32_t i = at.numbers[side];
  const std::uint64_t from = ring[i];
  const std::uint64_t to = ring[i + 1 < ring.size() ? i + 1 : 0];
  return forward ? from << 32U | to : to << 32U | from;
}

SphereMapBuffer PyramidDrawer::draw(const std::vector<FacetAtPoint>& at, const PointTable& points, PointId point) {
  SphereMapBuffer map;
  if (at.empty()) {
    map.assign_trivial(0);
    return map;
  }
  struct Whole {
    PlaneId plane;
    LabelId mark = 0;
  };
  std::vector<Whole> whole;  // planes whose circle is there
  const auto find_whole = [&](PlaneId plane) {
    return std::find_if(whole.begin(), whole.end(), [plane](const Whole& w) { return w.plane == plane; });
  };
  for (const FacetAtPoint& f : at) {
    if (f.sides[0].valid()) continue;
    const PlaneId plane = facets_.plane[f.facet];
    const LabelId in_sum = label(facets_.marks == BoundaryMarks::kMixed ? facets_.inside_marks[f.facet] : 0);
    if (find_whole(plane) == whole.end()) whole.push_back({plane, outside_mark(plane)});
    find_whole(plane)->mark |= in_sum;
  }
  centre_ = 0;
  arcs_.begin(facets_.planes, monitor_);
  for (const Whole& w : whole) {
    arcs_.add_circle(w.plane, w.mark);
    centre_ |= w.mark;
  }
  for (const FacetAtPoint& f : at) {
    if (!f.sides[0].valid()) continue;
    const auto under = find_whole(facets_.plane[f.facet]);
    if (under != whole.end() && ((under->mark & kInSum) != 0 || is_void(f.facet))) continue;
    draw_facet(f, points, point);
  }
  arcs_.finish(centre_, map);
  return map;
}

}  // namespace nef::minkowski
