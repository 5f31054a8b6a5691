// SPDX-License-Identifier: Apache-2.0
//
// First phase of the vertical decomposition.
#include <algorithm>
#include <limits>

#include "apps/minkowski/decomposition/wall_builder.h"
#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

// A ring without equal neighbours and without points inside its sides.
class WallRing {
 public:
  using Point = std::array<Rational, 2>;
  void push(const Point& p) {
    if (!points.empty() && points.back() == p) return;
    if (points.size() > 1 && between(points[points.size() - 2], points.back(), p)) {
      points.back() = p;
      return;
    }
    points.push_back(p);
  }
  std::vector<Point> points;

 private:
  static bool between(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) == (b[1] - a[1]) * (c[0] - a[0]) && (a[0] > b[0]) == (b[0] > c[0]) &&
           (a[1] > b[1]) == (b[1] > c[1]);
  }
};

SliceFrame sight_frame(const Rational3& from, const Rational3& to, std::size_t axis) {
  SliceFrame frame;
  frame.h = axis;
  frame.u = (axis + 1) % 3;
  if (from[frame.u] == to[frame.u]) frame.u = (axis + 2) % 3;
  frame.origin = from;
  const std::size_t w = frame.w();
  frame.slope = (to[w] - from[w]) / (to[frame.u] - from[frame.u]);
  return frame;
}

}  // namespace

WallBuilder::WallBuilder(const Complex& complex, std::size_t axis, const Monitor& monitor)
    : complex_(complex), axis_(axis), slicer_(complex, monitor), facets_of_volume_(complex.volume_count()) {
  for (const FacetId f : complex.facets.ids()) {
    const Facet& facet = complex.facets[f];
    facets_of_volume_[facet.volume_above].push_back(f);
    if (facet.volume_below != facet.volume_above) facets_of_volume_[facet.volume_below].push_back(f);
  }
}

void WallBuilder::add_face(const SliceFrame& frame, const std::vector<FlatPoint>& ring, Mesh& walls) {
  std::vector<std::uint32_t> face;
  for (const FlatPoint& p : ring) {
    face.push_back(static_cast<std::uint32_t>(walls.vertices.size()));
    walls.vertices.push_back(frame.lift(p));
  }
  walls.push_face(face);
}

std::vector<Rational> WallBuilder::breakpoints(const Rational& from, const Rational& to) const {
  std::vector<Rational> u = {from, to};
  for (const SliceSegment& s : slicer_.segments()) {
    for (const Rational& x : s.u) {
      if (x > from && x < to) u.push_back(x);
    }
  }
  std::sort(u.begin(), u.end());
  u.erase(std::unique(u.begin(), u.end()), u.end());
  return u;
}

// For each interval between breakpoints the nearest segment. Segments do not cross each other, nor
// the base, so the middle of the interval decides.
std::vector<WallBuilder::Run> WallBuilder::visible(const SliceSegment& base, const std::vector<Rational>& u,
                                                   bool upwards) const {
  const std::vector<SliceSegment>& segments = slicer_.segments();
  const int way = upwards ? 1 : -1;
  std::vector<Run> runs;
  for (std::uint32_t k = 0; k + 1 < u.size(); ++k) {
    const Rational middle = (u[k] + u[k + 1]) / 2;
    const double at = nearest_double(middle);
    std::uint32_t nearest = kNone;
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      const SliceSegment& s = segments[i];
      if (!(s.u[0] < middle) || !(middle < s.u[1])) continue;
      if (way * compare_heights(s, base, middle, at) <= 0) continue;
      if (nearest == kNone || way * compare_heights(s, segments[nearest], middle, at) < 0) nearest = i;
    }
    NEF_ASSERT(nearest != kNone);  // the volume is bounded
    if (!runs.empty() && runs.back().segment == nearest) {
      runs.back().last = k + 1;
    } else {
      runs.push_back({nearest, k, k + 1});
    }
  }
  return runs;
}

void WallBuilder::erect_sight_wall(const Rational3& from, const Rational3& to, bool upwards, Mesh& walls) {
  const SliceFrame frame = sight_frame(from, to, axis_);
  const bool forth = from[frame.u] < to[frame.u];
  const Rational3& left = forth ? from : to;
  const Rational3& right = forth ? to : from;
  const SliceSegment base = make_slice_segment({left[frame.u], left[frame.h]}, {right[frame.u], right[frame.h]});

  Box query;
  for (const Rational3* p : {&from, &to}) {
    query.add_rounded(nearest_doubles(*p));
  }
  (upwards ? query.high : query.low)[frame.h] = (upwards ? 1 : -1) * std::numeric_limits<double>::infinity();
  slicer_.begin(frame);
  slicer_.add_overlapping(query);
  const std::vector<Rational> u = breakpoints(base.u[0], base.u[1]);
  const std::vector<Run> runs = visible(base, u, upwards);

  // Along the edge, then back along what is seen.
  WallRing ring;
  ring.push({base.u[0], base.h[0]});
  ring.push({base.u[1], base.h[1]});
  for (std::size_t k = runs.size(); k-- > 0;) {
    const SliceSegment& s = slicer_.segments()[runs[k].segment];
    ring.push({u[runs[k].last], s.height(u[runs[k].last])});
    ring.push({u[runs[k].first], s.height(u[runs[k].first])});
  }
  if (ring.points.back() == ring.points.front()) ring.points.pop_back();
  add_face(frame, ring.points, walls);
}

void WallBuilder::erect(const ReflexEdge& edge, Mesh& walls) {
  const Rational3& from = slicer_.point(complex_.source(edge.halfedge));
  const Rational3& to = slicer_.point(complex_.target(edge.halfedge));
  if (edge.inside[0]) erect_sight_wall(from, to, false, walls);
  if (edge.inside[1]) erect_sight_wall(from, to, true, walls);
}

void WallBuilder::erect(const Rational3& from, const Rational3& to, Mesh& walls) {
  erect_sight_wall(from, to, false, walls);
  erect_sight_wall(from, to, true, walls);
}

}  // namespace nef::minkowski
