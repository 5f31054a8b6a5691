// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"

#include <algorithm>

#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

LabelId outside_mark(PlaneId plane) { return plane.flipped() ? kOutsideBelow : kOutsideAbove; }

}  // namespace

LabelId PyramidDrawer::label(std::uint8_t in_sum) const {
  const bool is_in = facets_.marks == BoundaryMarks::kMixed ? in_sum != 0 : facets_.marks == BoundaryMarks::kAll;
  return is_in ? kInSum : LabelId{0};
}

// Of the sides of a facet at a point of its border, and of the point.
PyramidDrawer::BorderLabels PyramidDrawer::border_labels(std::uint32_t facet, PointId point) const {
  if (facets_.marks != BoundaryMarks::kMixed) return {label(0), label(0), label(0)};
  const auto ring = facets_.ring(facet);
  const std::uint32_t begin = facets_.begin[facet];
  const auto order = [&](std::uint32_t corner, int axis) {
    return compare_coordinate(facets_.points, point, PointId{ring[corner]}, axis, monitor_);
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
    if (!between || !is_on_side(facet, i, point)) continue;
    const LabelId mark = label(facets_.side_marks[begin + i]);
    return {mark, mark, mark};
  }
  NEF_ASSERT(false);  // the point is on the border
  return {};
}

bool PyramidDrawer::is_on_side(std::uint32_t facet, std::uint32_t side, PointId point) const {
  const PlaneId plane = pyramids_.known_side_plane(facet, side);
  return plane.valid() && side_of_plane(facets_.planes, plane, facets_.points, point, monitor_) == 0;
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
void PyramidDrawer::draw_facet(const FacetAtPoint& at, PointId point, SphereMapBuffer& out) {
  const PlaneId plane = facets_.plane[at.facet];
  const LabelId bits = outside_mark(plane);
  const std::uint8_t inside = facets_.marks == BoundaryMarks::kMixed ? facets_.inside_marks[at.facet] : 0;
  const auto mark = static_cast<LabelId>(bits | label(inside));
  const PlaneTable& planes = facets_.planes;
  if (!at.sides[0].valid()) {
    out.assign_circle(plane, mark, 0, 0);
    out.mark = mark;
    return;
  }
  PlaneId leaving = at.sides[0];
  PlaneId arriving = at.sides[1].valid() ? at.sides[1] : leaving;
  if (at.sides[1].valid() && orientation_on_circle(planes, plane, Direction::cross(planes, arriving, plane),
                                                   Direction::cross(planes, leaving, plane), monitor_) < 0) {
    std::swap(leaving, arriving);
  }
  const BorderLabels border = border_labels(at.facet, point);
  drawing_.clear();
  drawing_.centre = bits | border.centre;
  drawing_.nodes.resize(2);
  drawing_.nodes[0].direction = Direction::cross(planes, leaving, plane);
  drawing_.nodes[0].mark = bits | border.leaving;
  drawing_.nodes[1].direction = Direction::cross(planes, plane, arriving);
  drawing_.nodes[1].mark = bits | border.arriving;
  drawing_.arcs.push_back({plane, 0, 1, mark, 0, 0});
  drawing_.sort_around_nodes(planes, monitor_);
  drawing_.simplify_and_assemble(planes, out, monitor_);
}

SphereMapBuffer PyramidDrawer::draw(const std::vector<FacetAtPoint>& at, PointId point) {
  SphereMapBuffer* map = &maps_[0];
  SphereMapBuffer* next = &maps_[1];
  if (at.empty()) map->assign_trivial(0);
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
  bool first = true;
  const auto add = [&] {
    if (first) {
      std::swap(*map, maps_[2]);
    } else {
      overlay_.overlay(facets_.planes, map->view(), maps_[2].view(), or_, *next, monitor_);
      std::swap(map, next);
    }
    first = false;
  };
  for (const Whole& w : whole) {
    maps_[2].assign_circle(w.plane, w.mark, 0, 0);
    maps_[2].mark = w.mark;
    add();
  }
  for (const FacetAtPoint& f : at) {
    const auto under = find_whole(facets_.plane[f.facet]);
    if (under != whole.end() && ((under->mark & kInSum) != 0 || is_void(f.facet))) continue;
    draw_facet(f, point, maps_[2]);
    add();
  }
  return *map;
}

}  // namespace nef::minkowski
