// SPDX-License-Identifier: Apache-2.0
//
// The part of VertexFinder for sums that need not be closed: where a passage may be as narrow as what passes, and where
// marks change.
#include <span>

#include "apps/minkowski/convolution/vertex_finder.h"

namespace nef::minkowski {

void VertexFinder::add_passages(std::span<const SaddlePoint> saddles) {
  for (const SaddlePoint& saddle : saddles) add_saddle_point(saddle);
  add_doubtful_places();
  draw_points();
}

// Before all others but ends of intervals. Whether the sum has a vertex there is not to be seen from facets.
void VertexFinder::add_saddle_point(const SaddlePoint& saddle) {
  const PointId point = meetings_.first_equal(result_.points.push(saddle.point));
  near_.clear();
  add_point(point);
  draw_points();
  KnownPoint& here = known(point.index());
  if (here.vertex == kNone) {
    PointDrawer drawer(in_.facets, in_.pyramids, in_.membership, monitor_);
    SphereMapBuffer map = drawer.draw_anyway(here.facets, result_.points, point);
    here.vertex = static_cast<std::uint32_t>(result_.vertices.size());
    result_.vertices.push_back({point, std::move(map), true, false});
  }
  RegionVertex& v = result_.vertices[here.vertex];
  v.is_saddle_point = true;
  if (saddle.mark != 0) v.map.mark |= kInSum;
}

// Points around passages: where facets are not in general position.
void VertexFinder::add_doubtful_places() {
  among_passages_ = true;
  for (const auto& [segment, cut] : in_.intervals.doubtful) {
    add_points_of(in_.intervals.segments[segment], in_.intervals.cuts[cut]);
  }
  for (const std::uint32_t corner : in_.intervals.touching) add_corner(corner);
  if (is_mixed_) add_changes_of_marks();
  in_.tree.for_each_pair([&](std::uint32_t f, std::uint32_t g) {
    if (in_.facets.plane[f].row() != in_.facets.plane[g].row()) return;
    if (is_mixed_ || in_.facets.plane[f] != in_.facets.plane[g]) add_crossings(f, g);
  });
}

// Corners at which the marks along the border of a facet change: where that is straight, no segment ends there.
void VertexFinder::add_changes_of_marks() {
  for (std::uint32_t f = 0; f < in_.facets.size(); ++f) {
    const std::uint32_t begin = in_.facets.begin[f];
    const std::uint32_t end = in_.facets.begin[f + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint8_t mark = in_.facets.corner_marks[i];
      const std::uint8_t before = in_.facets.side_marks[i > begin ? i - 1 : end - 1];
      if (mark != before || mark != in_.facets.side_marks[i]) add_corner(in_.facets.corners[i]);
    }
  }
}

// The corners of two facets in one plane that the other one holds, and where their sides cross.
void VertexFinder::add_crossings(std::uint32_t f, std::uint32_t g) {
  const auto ring = in_.facets.ring(f);
  const auto other = in_.facets.ring(g);
  const auto box_of = [&](std::span<const std::uint32_t> corners, std::size_t i) {
    Box box;
    box.add_rounded(in_.facets.rounded[corners[i]]);
    box.add_rounded(in_.facets.rounded[corners[i + 1 < corners.size() ? i + 1 : 0]]);
    return box;
  };
  for (const std::uint32_t corner : ring) {
    if (in_.pyramids.holds(g, in_.facets.points, PointId{corner}, monitor_)) add_corner(corner);
  }
  for (const std::uint32_t corner : other) {
    if (in_.pyramids.holds(f, in_.facets.points, PointId{corner}, monitor_)) add_corner(corner);
  }
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const Box side = box_of(ring, i);
    for (std::uint32_t j = 0; j < other.size(); ++j) {
      if (!side.overlaps(box_of(other, j))) continue;
      add_meeting_of({in_.facets.plane[f], in_.pyramids.side_plane(f, i), in_.pyramids.side_plane(g, j)});
    }
  }
}

}  // namespace nef::minkowski
