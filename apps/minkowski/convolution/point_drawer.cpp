// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/point_drawer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "apps/minkowski/convolution/marks/boundary_marker.h"

namespace nef::minkowski {
namespace {

// Marks sfaces that are just behind a facet; true if any is not.
bool mark_inside(SphereMapBuffer& map) {
  const auto visit = [&map](const auto& half) {
    const LabelId behind = half.plane.flipped() ? kOutsideAbove : kOutsideBelow;
    if ((half.mark & behind) != 0) map.sfaces[half.sface].mark = 1;
  };
  for (SFace& f : map.sfaces) f.mark = 0;
  for (const SHalfedge& e : map.shalfedges) visit(e);
  for (const SLoop& l : map.sloops) visit(l);
  return std::any_of(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark == 0; });
}

// True if a closed sum has no vertex at a point, whichever of the regions that are not known to be inside are. One such
// region whose border lies on one great circle is a half-space, and one with a border on two does not change along
// the line in which their planes meet; nor does anything around a point on an edge with nothing across it.
bool is_plain(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor) {
  if (map.svertices.empty()) return true;
  if (map.svertices.size() == 2 && same_direction(direction_of(planes, map.svertices[0]),
                                                  direction_of(planes, map.svertices[1]).negated(), monitor)) {
    return true;
  }
  const auto is_open = [](const SFace& f) { return f.mark == 0; };
  const auto open = std::find_if(map.sfaces.begin(), map.sfaces.end(), is_open);
  if (open == map.sfaces.end() || std::find_if(open + 1, map.sfaces.end(), is_open) != map.sfaces.end()) return false;
  const auto face = static_cast<std::uint32_t>(open - map.sfaces.begin());
  std::array<PlaneId, 2> border;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    const SHalfedge& half = map.shalfedges[e];
    if (half.sface != face) continue;
    if (map.shalfedges[e ^ 1U].sface == face) return false;
    const auto same = [&](PlaneId p) { return p.valid() && p.row() == half.plane.row(); };
    if (same(border[0]) || same(border[1])) continue;
    if (border[1].valid()) return false;
    border[border[0].valid() ? 1 : 0] = half.plane;
  }
  return open->entry_count == 1 && map.sloops.empty();
}

}  // namespace

PointDrawer::PointDrawer(const ConvolutionFacets& facets, const FacetPyramids& pyramids,
                         const SumMembership& membership, const Monitor& monitor)
    : facets_(facets),
      membership_(membership),
      monitor_(monitor),
      drawer_(facets, pyramids, monitor),
      inside_(membership, monitor) {}

std::optional<RegionVertex> PointDrawer::draw(const std::vector<FacetAtPoint>& at, const PointTable& points,
                                              PointId point, bool among_passages) {
  if (inside_.has(near_point(points, point))) return std::nullopt;
  SphereMapBuffer map = drawer_.draw(at, points, point);
  const bool open = mark_inside(map);
  if (!is_of_use(points, point, open, among_passages, map.view())) return std::nullopt;
  const bool plain = facets_.marks == BoundaryMarks::kAll && is_plain(facets_.planes, map.view(), monitor_);
  return RegionVertex{point, std::move(map), false, plain};
}

SphereMapBuffer PointDrawer::draw_anyway(const std::vector<FacetAtPoint>& at, const PointTable& points, PointId point) {
  SphereMapBuffer map = drawer_.draw(at, points, point);
  mark_inside(map);
  return map;
}

// True if the sum may have a vertex at a point. `open`: not all regions around it are known to be inside.
bool PointDrawer::is_of_use(const PointTable& points, PointId point, bool open, bool among_passages,
                            const SphereMapView& map) const {
  if (facets_.marks == BoundaryMarks::kAll || (open && !among_passages)) return open;
  if (!open && !BoundaryMarker::may_have_passages(map)) return false;
  return !membership_.surely_in_inside(points.rational(point), monitor_);
}

}  // namespace nef::minkowski
