// SPDX-License-Identifier: Apache-2.0
//
// Second phase of the vertical decomposition. In the slice with an upright plane the volume is the
// region between a floor and a ceiling; the wall is swept from the edge along u, interval by
// interval between the ends of segments, until floor and ceiling meet or an upright segment closes the gap.
#include <algorithm>

#include "apps/minkowski/decomposition/wall_builder.h"
#include "nef/base/error.h"

namespace nef::minkowski {

// All ends of segments and uprights from `from` on, in the order of the sweep.
std::vector<Rational> WallBuilder::stops(const Rational& from, int way) const {
  std::vector<Rational> u = {from};
  const auto add = [&](const Rational& x) {
    if (way * cmp(x, from) > 0) u.push_back(x);
  };
  for (const SliceSegment& s : slicer_.segments()) {
    add(s.u[0]);
    add(s.u[1]);
  }
  for (const SliceUpright& s : slicer_.uprights()) add(s.u);
  std::sort(u.begin(), u.end());
  u.erase(std::unique(u.begin(), u.end()), u.end());
  if (way < 0) std::reverse(u.begin(), u.end());
  return u;
}

// The neighbouring segments over [from, to] that enclose part of the interval (low, high) at `from`.
WallBuilder::Gap WallBuilder::find_gap(const Rational& from, const Rational& to, const Rational& low,
                                       const Rational& high) const {
  const Rational middle = (from + to) / 2;
  const double at = nearest_double(middle);
  std::vector<const SliceSegment*> order;
  for (const SliceSegment& s : slicer_.segments()) {
    if (s.u[0] < middle && middle < s.u[1]) order.push_back(&s);
  }
  std::sort(order.begin(), order.end(),
            [&](const SliceSegment* a, const SliceSegment* b) { return compare_heights(*a, *b, middle, at) < 0; });
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    if (!(order[i]->height(from) < high) || !(order[i + 1]->height(from) > low)) continue;
    if (compare_heights(*order[i], *order[i + 1], middle, at) == 0) continue;  // an edge that two facets share
    return {order[i], order[i + 1]};
  }
  return {};
}

// Whether uprights at `at` cover all of [low, high].
bool WallBuilder::blocked(const Rational& at, Rational low, const Rational& high) const {
  std::vector<const SliceUpright*> here;
  for (const SliceUpright& s : slicer_.uprights()) {
    if (s.u == at) here.push_back(&s);
  }
  std::sort(here.begin(), here.end(), [](const SliceUpright* a, const SliceUpright* b) { return a->low < b->low; });
  for (const SliceUpright* s : here) {
    if (s->low > low) return false;
    low = std::max(low, s->high);
  }
  return low >= high;
}

void WallBuilder::erect(const ReflexEdge& edge, const CrossWall& wall, Mesh& walls) {
  if (wall.inside[0]) erect_cross_wall(edge, wall.plane, -1, walls);
  if (wall.inside[1]) erect_cross_wall(edge, wall.plane, 1, walls);
}

void WallBuilder::erect_cross_wall(const ReflexEdge& edge, PlaneId plane, int way, Mesh& walls) {
  const Rational3& a = slicer_.point(complex_.source(edge.halfedge));
  const Rational3& b = slicer_.point(complex_.target(edge.halfedge));
  SliceFrame frame;
  frame.u = cross_axis(complex_, plane, axis_);
  frame.h = axis_;
  frame.origin = a;
  if (plane.valid()) {
    // Along a x + b y = const one coordinate changes with the other.
    frame.slope = Rational(complex_.planes.oriented_coefficient(plane, frame.u));
    frame.slope /= Rational(complex_.planes.oriented_coefficient(plane, frame.w()));
    frame.slope = -frame.slope;
  }
  Rational low = std::min(a[axis_], b[axis_]);
  Rational high = std::max(a[axis_], b[axis_]);

  slicer_.begin(frame);
  for (const FacetId f : facets_of_volume_[edge.volume]) slicer_.add_facet(f);
  const std::vector<Rational> u = stops(a[frame.u], way);
  std::vector<FlatPoint> floor;
  std::vector<FlatPoint> ceiling;
  const auto push = [](std::vector<FlatPoint>& chain, FlatPoint p) {
    if (!chain.empty() && chain.back() == p) return;
    if (chain.size() > 1) {
      const FlatPoint& o = chain[chain.size() - 2];
      const FlatPoint& q = chain.back();
      // Along the sweep u only advances or stands still, where the chain jumps.
      if (o[0] != q[0] && q[0] != p[0] && (q[1] - o[1]) * (p[0] - o[0]) == (p[1] - o[1]) * (q[0] - o[0])) {
        chain.back() = std::move(p);
        return;
      }
    }
    chain.push_back(std::move(p));
  };
  for (std::size_t k = 0; k + 1 < u.size(); ++k) {
    const Gap gap = find_gap(u[k], u[k + 1], low, high);
    if (gap.low == nullptr) break;
    if (k > 0 && blocked(u[k], std::max(low, gap.low->height(u[k])), std::min(high, gap.high->height(u[k])))) break;
    for (const std::size_t end : {k, k + 1}) {
      low = gap.low->height(u[end]);
      high = gap.high->height(u[end]);
      push(floor, {u[end], low});
      push(ceiling, {u[end], high});
    }
    if (low == high) break;
  }
  NEF_ASSERT(!floor.empty());  // the edge was found to have the volume on that side
  if (floor.back() == ceiling.back()) ceiling.pop_back();
  if (floor.front() == ceiling.front()) ceiling.erase(ceiling.begin());
  std::vector<FlatPoint> ring = std::move(floor);
  ring.insert(ring.end(), ceiling.rbegin(), ceiling.rend());
  add_face(frame, ring, walls);
}

}  // namespace nef::minkowski
