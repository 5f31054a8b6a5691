// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/convolution_regions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/minkowski/convolution/direction_into.h"
#include "nef/base/error.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/synthesis/complex_builder.h"

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

double reach_of(const FacetSegment& s) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, std::fabs(s.to[i] - s.from[i]));
  return reach;
}

std::size_t main_axis(const FacetSegment& s) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(s.to[i] - s.from[i]) > std::fabs(s.to[axis] - s.from[axis])) axis = i;
  }
  return axis;
}

}  // namespace

ConvolutionRegions::ConvolutionRegions(ConvolutionFacets& facets, const RoundedFacets& rounded,
                                       const SurvivingIntervals& intervals)
    : facets_(facets),
      intervals_(intervals),
      tree_(rounded.boxes()),
      pyramids_(facets, rounded, tree_),
      meetings_(facets.planes, facets.points) {}

void ConvolutionRegions::add_corner(std::uint32_t corner) { add_point(meetings_.first_equal(PointId{corner})); }

void ConvolutionRegions::add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h) {
  const std::optional<Meeting> meeting = meetings_.meet({facets_.plane[f], facets_.plane[g], facets_.plane[h]});
  if (meeting) add_point(meeting->point);
}

void ConvolutionRegions::add_point(PointId point) {
  near_.push_back(point.index());
  const auto [at, is_new] = known_.emplace(point.index(), KnownPoint());
  if (!is_new) return;
  ++counts_.points;
  KnownPoint& known = at->second;
  const std::vector<FacetAtPoint>& facets = pyramids_.facets_at(point);
  for (const FacetAtPoint& f : facets) known.facets.push_back(f.facet);
  std::sort(known.facets.begin(), known.facets.end());
  if (facets.size() < 3) return;
  SphereMapBuffer map = pyramids_.draw(facets);
  if (!mark_inside(map)) return;
  known.vertex = static_cast<std::uint32_t>(vertices_.size());
  vertices_.push_back({point, std::move(map), 0});
}

// The points where the facet beyond a side may meet the segment's facets.
void ConvolutionRegions::add_points_beyond(std::uint32_t f, std::uint32_t g, const SegmentEnd& end) {
  for (const std::uint32_t h : intervals_.at_side.at(side_key(facets_, end.facet, end.index))) add_meeting(f, g, h);
}

// Corners and sides of a facet near a cut.
void ConvolutionRegions::add_points_near(const FacetSegment& s, const SegmentCut& cut, std::uint32_t facet) {
  const Box box = s.box_of({std::max(cut.at.low, 0.0), std::min(cut.at.high, 1.0)});
  const auto ring = facets_.ring(facet);
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    Box corner;
    corner.add_rounded(facets_.rounded[ring[i]]);
    if (corner.overlaps(box)) add_corner(ring[i]);
    Box side = corner;
    side.add_rounded(facets_.rounded[ring[i + 1 < ring.size() ? i + 1 : 0]]);
    if (side.overlaps(box)) add_points_beyond(s.f, s.g, {SegmentEnd::Kind::kSide, facet, i});
  }
}

void ConvolutionRegions::add_points_of(const FacetSegment& s, const SegmentCut& cut) {
  near_.clear();
  for (std::uint32_t i = cut.first; i < cut.last; ++i) add_meeting(s.f, s.g, intervals_.cutting[i]);
  const bool is_end = cut.is_end[0] || cut.is_end[1];
  const bool simple = is_end ? cut.first == cut.last && cut.is_end[0] != cut.is_end[1] : cut.last - cut.first == 1;
  for (const std::size_t k : {0U, 1U}) {
    if (!cut.is_end[k]) continue;
    if (s.ends[k].kind == SegmentEnd::Kind::kCorner) add_corner(s.ends[k].index);
    if (s.ends[k].kind == SegmentEnd::Kind::kSide) add_points_beyond(s.f, s.g, s.ends[k]);
  }
  const bool unsure = (cut.is_end[0] && s.ends[0].kind == SegmentEnd::Kind::kUnsure) ||
                      (cut.is_end[1] && s.ends[1].kind == SegmentEnd::Kind::kUnsure);
  if (simple && !unsure) return;
  add_points_near(s, cut, s.f);
  add_points_near(s, cut, s.g);
  for (std::uint32_t i = cut.first; i < cut.last; ++i) add_points_near(s, cut, intervals_.cutting[i]);
}

// Of the points of the segment at a cut, the first or last one.
std::uint32_t ConvolutionRegions::nearest(const FacetSegment& s, const SegmentCut& cut, bool last) const {
  const std::size_t axis = main_axis(s);
  const double length = s.to[axis] - s.from[axis];
  const double doubt = 4 * s.error / std::fabs(length) + 1e-12;
  const bool up = length > 0;
  std::uint32_t best = kNone;
  for (const std::uint32_t p : near_) {
    const PointId point{p};
    const double t = (facets_.points.approximate(point)[axis] - s.from[axis]) / length;
    if (!(t >= cut.at.low - doubt && t <= cut.at.high + doubt)) continue;
    const std::vector<std::uint32_t>& here = known_.at(p).facets;
    if (!std::binary_search(here.begin(), here.end(), s.f) || !std::binary_search(here.begin(), here.end(), s.g))
      continue;
    if (best == kNone ||
        (compare_coordinate(facets_.points, point, PointId{best}, static_cast<int>(axis)) > 0) == (up == last)) {
      best = p;
    }
  }
  return best;
}

void ConvolutionRegions::add_interval(const SurvivingInterval& interval) {
  const FacetSegment& s = intervals_.segments[interval.segment];
  add_points_of(s, intervals_.cuts[interval.from]);
  const std::uint32_t from = nearest(s, intervals_.cuts[interval.from], true);
  if (interval.from == interval.to) return;
  add_points_of(s, intervals_.cuts[interval.to]);
  const std::uint32_t to = nearest(s, intervals_.cuts[interval.to], false);
  if (from == kNone || to == kNone || from == to || reach_of(s) < 100 * s.error) return;
  const std::uint32_t v = known_.at(from).vertex;
  const std::uint32_t w = known_.at(to).vertex;
  if (v != kNone && w != kNone) joints_.push_back({interval.segment, v, w});
}

std::uint32_t ConvolutionRegions::svertex_along(const Vertex& v, const FacetSegment& s, bool forward) const {
  Direction d = Direction::cross(facets_.planes, facets_.plane[s.f], facets_.plane[s.g]);
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += d.approximate[i] * (s.to[i] - s.from[i]);
  if ((along > 0) != forward) d = d.negated();
  for (std::uint32_t i = 0; i < v.map.svertices.size(); ++i) {
    if (same_direction(direction_of(facets_.planes, v.map.svertices[i]), d)) return i;
  }
  return kNone;
}

// The same half-planes leave both ends of the interval, and the same regions lie between them. Seen from the other end
// a half-plane is that of the opposite plane, and has the region on its other side.
void ConvolutionRegions::join(const FacetSegment& s, const Vertex& from, const Vertex& to) {
  const std::uint32_t here = svertex_along(from, s, true);
  const std::uint32_t there = svertex_along(to, s, false);
  if (here == kNone || there == kNone) return;
  const SphereMapView a = from.map.view();
  const SphereMapView b = to.map.view();
  const std::uint32_t first = a.svertices[here].out;
  const std::uint32_t first_there = b.svertices[there].out;
  std::uint32_t e = first;
  do {
    std::uint32_t h = first_there;
    do {
      if (b.shalfedges[h].plane == a.shalfedges[e].plane.opposite()) {
        regions_.unite(from.first_region + a.shalfedges[e].sface, to.first_region + b.shalfedges[h ^ 1U].sface);
      }
      h = b.next_around(h);
    } while (h != first_there);
    e = a.next_around(e);
  } while (e != first);
}

// A point of a region near a vertex, so near that no facet is between.
Rational3 ConvolutionRegions::point_in(const Vertex& v, std::uint32_t sface) {
  const std::array<Integer, 3> d = direction_into(facets_.planes, v.map.view(), sface).integers();
  const Rational3 at = facets_.points.rational(v.point);
  const std::vector<FacetAtPoint> here = pyramids_.facets_at(v.point);
  const Box bounds = tree_.bounds();
  double extent = 0;
  std::size_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max(extent, bounds.high[i] - bounds.low[i]);
    bits = std::max(bits, mpz_sizeinbase(d[i].get_mpz_t(), 2));
  }
  int exponent = 0;
  std::frexp(extent, &exponent);
  for (int step = exponent - static_cast<int>(bits) - 3;; step -= 2) {
    Rational factor(1);
    if (step < 0) {
      mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-step));
    } else {
      mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(step));
    }
    Rational3 x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = at[i] + factor * d[i];
    const PointId there = facets_.points.push(x);
    const bool clear = pyramids_.sees(v.point, there, here);
    facets_.points.pop();
    if (clear) return x;
  }
}

// For each region around a vertex whether it is inside.
std::vector<std::uint8_t> ConvolutionRegions::find_inside(const Contains& contains,
                                                          const std::function<void(double)>& poll) {
  enum : std::uint8_t { kOut, kIn, kUnknown };
  std::vector<std::uint8_t> state(regions_.size(), kUnknown);
  for (const Vertex& v : vertices_) {
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      if (v.map.sfaces[f].mark != 0) state[regions_.find(v.first_region + f)] = kIn;
    }
  }
  for (const Vertex& v : vertices_) {
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      std::uint8_t& known = state[regions_.find(v.first_region + f)];
      if (known != kUnknown) continue;
      poll(1);
      ++counts_.regions;
      known = contains(point_in(v, f)) ? kIn : kOut;
    }
  }
  for (std::uint32_t r = 0; r < state.size(); ++r) state[r] = state[regions_.find(r)];
  return state;
}

std::variant<Complex, Defect> ConvolutionRegions::run(const Contains& contains,
                                                      const std::function<void(double)>& poll) {
  for (std::size_t i = 0; i < intervals_.intervals.size(); ++i) {
    if (i % 64 == 0) poll(static_cast<double>(i) / static_cast<double>(intervals_.intervals.size()));
    add_interval(intervals_.intervals[i]);
  }
  std::uint32_t regions = 0;
  for (Vertex& v : vertices_) {
    v.first_region = regions;
    regions += static_cast<std::uint32_t>(v.map.sfaces.size());
  }
  regions_.reset(regions);
  for (const Joint& j : joints_) join(intervals_.segments[j.segment], vertices_[j.from], vertices_[j.to]);
  const std::vector<std::uint8_t> inside = find_inside(contains, poll);
  ComplexBuilder builder(facets_.planes);
  Arrangement drawing;
  for (Vertex& v : vertices_) {
    bool all = true;
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      v.map.sfaces[f].mark = inside[v.first_region + f];
      all = all && v.map.sfaces[f].mark != 0;
    }
    if (all) continue;
    // The sum is closed.
    for (SHalfedge& e : v.map.shalfedges) e.mark = 1;
    for (SLoop& l : v.map.sloops) l.mark = 1;
    for (SVertex& s : v.map.svertices) s.mark = 1;
    v.map.mark = 1;
    drawing.load(facets_.planes, v.map.view());
    builder.add(facets_.points, v.point, drawing);
  }
  return builder.try_finish(0);
}

}  // namespace nef::minkowski
