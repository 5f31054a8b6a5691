// SPDX-License-Identifier: Apache-2.0
//
// Each end of an interval is a corner of a facet, a crossing of a side with a facet, or a point where three facets
// meet; which of these it is may be unsure, and then all of them are candidates. Candidates are found exactly and known
// by their number, so that each is drawn once, in batches on several threads: all facets that hold it, as an
// arrangement on a sphere, with the regions behind them marked. Points at which every region is inside are dropped.
// Where many facets meet in a point or along a line, so do all pairs of them, but only the first one looks for
// candidates there: that a known point is the only one at an end, or that in which three facets meet, or that a known
// line is that of another pair, is told exactly, by the facets that contain points.
#include "apps/minkowski/convolution/vertex_finder.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/minkowski/minkowski.h"
#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

double reach_of(const FacetSegment& s) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, std::fabs(s.to[i] - s.from[i]));
  return reach;
}

Box widened(Box box, double by) {
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] -= by;
    box.high[i] += by;
  }
  return box;
}

std::size_t main_axis(const FacetSegment& s) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(s.to[i] - s.from[i]) > std::fabs(s.to[axis] - s.from[axis])) axis = i;
  }
  return axis;
}

}  // namespace

VertexFinder::VertexFinder(const FacetArrangement& arrangement, const Monitor& monitor)
    : in_(arrangement),
      monitor_(monitor),
      is_mixed_(in_.facets.marks == BoundaryMarks::kMixed),
      meetings_(in_.facets.planes, result_.points),
      places_(in_.rounded.extent()),
      asked_(in_.facets.planes.size(), 0) {}

void VertexFinder::add_corner(std::uint32_t corner) {
  const auto [at, is_new] = corners_.emplace(corner, 0);
  if (is_new) {
    const PointId pushed = result_.points.push_from(in_.facets.points, PointId{corner});
    const PointId first = meetings_.first_equal(pushed);
    if (first != pushed) result_.points.pop();
    at->second = first.index();
  }
  add_point(PointId{at->second});
}

// Where the facets of a segment meet a third one, each plane once at a cut.
void VertexFinder::add_meeting(const FacetSegment& s, std::uint32_t h) {
  std::uint32_t& asked = asked_[in_.facets.plane[h].row()];
  if (asked == cut_) return;
  asked = cut_;
  if (const std::uint32_t point = known_meeting(s, h); point != kNone) {
    near_.push_back(point);
    return;
  }
  add_meeting_of({in_.facets.plane[s.f], in_.facets.plane[s.g], in_.facets.plane[h]});
}

// The point of three facets, if it is known: it is on all of them, and the line of the segment surely crosses the plane
// of the third one. It is looked for about where that is in doubles; kNone if it is not found there.
std::uint32_t VertexFinder::known_meeting(const FacetSegment& s, std::uint32_t h) const {
  const FormOnSegment form(in_.rounded.plane(h), s);
  if (!form.surely_changes()) return kNone;
  const Double3 about = s.at(-form.at / form.slope);
  const std::span<const std::uint32_t> near = places_.near({about, about});
  constexpr std::size_t kMost = 8;  // where more are closer than doubles tell, computing the point takes less
  for (const std::uint32_t point : near.first(std::min(near.size(), kMost))) {
    const KnownPoint& here = known(point);
    if (here.find(h) != nullptr && here.find(s.f) != nullptr && here.find(s.g) != nullptr) return point;
  }
  return kNone;
}

void VertexFinder::add_meeting_of(const std::array<PlaneId, 3>& planes) {
  const std::optional<Meeting> meeting = meetings_.meet(planes);
  if (meeting) add_point(meeting->point);
}

void VertexFinder::add_point(PointId point) {
  near_.push_back(point.index());
  if (find_known(point.index()) != nullptr) return;
  if (point.index() >= number_.size()) number_.resize(point.index() + 1, kNone);
  number_[point.index()] = static_cast<std::uint32_t>(known_.size());
  ++result_.located;
  KnownPoint& here = known_.emplace_back();
  in_.pyramids.facets_at(result_.points, point, here.facets, monitor_);
  std::sort(here.facets.begin(), here.facets.end(),
            [](const FacetAtPoint& f, const FacetAtPoint& g) { return f.facet < g.facet; });
  places_.add(result_.points.approximate(point), point.index());
  // Where marks are mixed, a corner in the middle of another facet may be a vertex.
  if (here.facets.size() < (is_mixed_ ? 1 : 3)) return;
  undrawn_.push_back(point);
  constexpr std::size_t kManyPoints = 4096;
  if (undrawn_.size() >= kManyPoints) draw_points();
}

// What is put off so that several threads have something to do.
void VertexFinder::draw_points() {
  constexpr std::size_t kAtOnce = 64;
  std::vector<std::optional<RegionVertex>> drawn(undrawn_.size());
  parallel_for_ranges(undrawn_.size(), kAtOnce, monitor_, [&](std::size_t first, std::size_t last, const Monitor& own) {
    PointDrawer drawer(in_.facets, in_.pyramids, in_.membership, own);
    for (std::size_t i = first; i < last; ++i) {
      drawn[i] = drawer.draw(known(undrawn_[i].index()).facets, result_.points, undrawn_[i], among_passages_);
    }
  });
  for (std::size_t i = 0; i < undrawn_.size(); ++i) {
    if (!drawn[i]) continue;
    known(undrawn_[i].index()).vertex = static_cast<std::uint32_t>(result_.vertices.size());
    result_.vertices.push_back(*std::move(drawn[i]));
  }
  undrawn_.clear();
}

// The points where the facet beyond a side may meet the segment's facets. Where marks are mixed, also where the segment
// crosses the side itself: the side, or what is beyond it in the same plane, may be marked otherwise, and no three of
// the planes tell of that.
void VertexFinder::add_points_beyond(const FacetSegment& s, const SegmentEnd& end) {
  for (const std::uint32_t h : in_.at_side(end.facet, end.index)) add_meeting(s, h);
  if (!is_mixed_) return;
  add_meeting_of({in_.facets.plane[s.f], in_.facets.plane[s.g], in_.pyramids.side_plane(end.facet, end.index)});
}

// Corners and sides of a facet near a cut of a segment, which is in a box.
void VertexFinder::add_points_near(const FacetSegment& s, const Box& box, std::uint32_t facet) {
  const auto ring = in_.facets.ring(facet);
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    Box corner;
    corner.add_rounded(in_.facets.rounded[ring[i]]);
    if (corner.overlaps(box)) add_corner(ring[i]);
    Box side = corner;
    side.add_rounded(in_.facets.rounded[ring[i + 1 < ring.size() ? i + 1 : 0]]);
    if (side.overlaps(box)) add_points_beyond(s, {SegmentEnd::Kind::kSide, facet, i});
  }
}

// Whether the segment of two facets goes on from a point of both, towards its start and towards its end.
std::array<bool, 2> VertexFinder::goes_on_from(const FacetAtPoint& f, const FacetAtPoint& g,
                                               const FacetSegment& s) const {
  Direction d = Direction::cross(in_.facets.planes, in_.facets.plane[s.f], in_.facets.plane[s.g]);
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += d.approximate[i] * (s.to[i] - s.from[i]);
  if (along > 0) d = d.negated();
  const auto both_go = [&](const Direction& to) {
    return in_.pyramids.goes_on(f, to, monitor_) && in_.pyramids.goes_on(g, to, monitor_);
  };
  return {both_go(d), both_go(d.negated())};
}

// True if nothing of a segment at a cut can be a vertex but this point: both facets hold it, and it is all of the
// segment; or the segment goes through it or ends there, and each facet that cuts holds the point, and surely no other
// of the segment's line.
bool VertexFinder::is_only_point(std::uint32_t point, const FacetSegment& s, const SegmentCut& cut) const {
  const KnownPoint& here = known(point);
  const FacetAtPoint* f = here.find(s.f);
  const FacetAtPoint* g = here.find(s.g);
  if (f == nullptr || g == nullptr) return false;
  if (cut.is_end[0] || cut.is_end[1]) {
    const std::array<bool, 2> goes_on = goes_on_from(*f, *g, s);
    if (!goes_on[0] && !goes_on[1]) return true;
    if ((cut.is_end[0] && goes_on[0]) || (cut.is_end[1] && goes_on[1])) return false;
  }
  return std::all_of(in_.intervals.cutting.begin() + cut.first, in_.intervals.cutting.begin() + cut.last,
                     [&](std::uint32_t h) {
                       return here.find(h) != nullptr && FormOnSegment(in_.rounded.plane(h), s).surely_changes();
                     });
}

// A point that is known already and the only one at a cut. Where many facets meet in a point, so do as many segments as
// pairs of them, and only the first of these has to look for it. kNone if that is not sure. Not where marks are mixed:
// there a side may count that is in the plane of one of the facets.
std::uint32_t VertexFinder::only_point_of(const FacetSegment& s, const SegmentCut& cut) const {
  if (is_mixed_) return kNone;
  for (const std::uint32_t point : places_.near(s.box_of({std::max(cut.at.low, 0.0), std::min(cut.at.high, 1.0)}))) {
    if (is_only_point(point, s, cut)) return point;
  }
  return kNone;
}

void VertexFinder::add_points_of(const FacetSegment& s, const SegmentCut& cut) {
  near_.clear();
  ++cut_;
  if (const std::uint32_t point = only_point_of(s, cut); point != kNone) {
    near_.push_back(point);
    return;
  }
  if (is_mixed_ || !cut.is_end[0] || !cut.is_end[1]) {
    look_for_points_of(s, cut, 0);
    return;
  }
  if (KnownLine* line = known_lines_.find(s.f, s.g, s.box_of({0, 1}))) {
    add_points_of_line(s, cut, *line);
    return;
  }
  look_for_points_of(s, cut, places_.size());
  add_known_line(s, cut);
}

// The points on a line are those at which it meets planes and corners: what one pair of facets along it has found, so
// has each other one, but for facets that were not looked at.
void VertexFinder::add_points_of_line(const FacetSegment& s, const SegmentCut& cut, KnownLine& line) {
  near_ = line.points;
  const std::size_t looked_at = line.facets.size();
  for (std::uint32_t i = cut.first; i < cut.last; ++i) {
    const std::uint32_t h = in_.intervals.cutting[i];
    if (std::find(line.facets.begin(), line.facets.end(), h) != line.facets.end()) continue;
    add_meeting(s, h);
    add_points_near(s, line.box, h);
    line.facets.push_back(h);
  }
  if (line.facets.size() == looked_at) return;
  line.points = near_;
  for (const std::uint32_t f : facets_along(s, std::span(line.facets).subspan(looked_at))) {
    known_lines_.add_along(line, f);
  }
}

void VertexFinder::add_known_line(const FacetSegment& s, const SegmentCut& cut) {
  KnownLine line;
  line.facets = {s.f, s.g};
  line.facets.insert(line.facets.end(), in_.intervals.cutting.begin() + cut.first,
                     in_.intervals.cutting.begin() + cut.last);
  line.points = near_;
  line.box = widened(s.box_of({0, 1}), places_.size());
  line.along = facets_along(s, line.facets);
  if (line.along.size() > 2) known_lines_.add(std::move(line));  // else there is no other pair
}

// Those that surely have the line of a segment in their planes, with the segment's own: two of the points near it are
// on them and on the line. Leaves each of these points there once.
std::vector<std::uint32_t> VertexFinder::facets_along(const FacetSegment& s, std::span<const std::uint32_t> facets) {
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  std::vector<const KnownPoint*> on_line;
  for (const std::uint32_t p : near_) {
    const KnownPoint& here = known(p);
    if (here.find(s.f) != nullptr && here.find(s.g) != nullptr) on_line.push_back(&here);
  }
  std::vector<std::uint32_t> result;
  for (const std::uint32_t f : facets) {
    const auto count =
        std::count_if(on_line.begin(), on_line.end(), [f](const KnownPoint* p) { return p->find(f) != nullptr; });
    if (count >= 2) result.push_back(f);
  }
  return result;
}

// All points that may be vertices, and others; also those that are so far beyond the cut.
void VertexFinder::look_for_points_of(const FacetSegment& s, const SegmentCut& cut, double beyond) {
  for (std::uint32_t i = cut.first; i < cut.last; ++i) add_meeting(s, in_.intervals.cutting[i]);
  const bool is_end = cut.is_end[0] || cut.is_end[1];
  const bool simple = is_end ? cut.first == cut.last && cut.is_end[0] != cut.is_end[1] : cut.last - cut.first == 1;
  for (const std::size_t k : {0U, 1U}) {
    if (!cut.is_end[k]) continue;
    if (s.ends[k].kind == SegmentEnd::Kind::kCorner) add_corner(s.ends[k].index);
    if (s.ends[k].kind == SegmentEnd::Kind::kSide) add_points_beyond(s, s.ends[k]);
  }
  const bool unsure = (cut.is_end[0] && s.ends[0].kind == SegmentEnd::Kind::kUnsure) ||
                      (cut.is_end[1] && s.ends[1].kind == SegmentEnd::Kind::kUnsure);
  if (simple && !unsure) return;
  const Box box = widened(s.box_of({std::max(cut.at.low, 0.0), std::min(cut.at.high, 1.0)}), beyond);
  add_points_near(s, box, s.f);
  add_points_near(s, box, s.g);
  for (std::uint32_t i = cut.first; i < cut.last; ++i) add_points_near(s, box, in_.intervals.cutting[i]);
}

// Of the points of the segment at a cut, the first or last one.
std::uint32_t VertexFinder::nearest(const FacetSegment& s, const SegmentCut& cut, bool last) const {
  const std::size_t axis = main_axis(s);
  const double length = s.to[axis] - s.from[axis];
  // Below, t is off by the errors of a point and of both ends, each at most that of the segment, and by a few roundings
  // of numbers of at most about 1; the cut's range has room for its own.
  const double doubt = 4 * s.error / std::fabs(length) + 1e-12;
  const bool up = length > 0;
  std::uint32_t best = kNone;
  for (const std::uint32_t p : near_) {
    const PointId point{p};
    const double t = (result_.points.approximate(point)[axis] - s.from[axis]) / length;
    if (!(t >= cut.at.low - doubt && t <= cut.at.high + doubt)) continue;
    const KnownPoint& here = known(p);
    if (here.find(s.f) == nullptr || here.find(s.g) == nullptr) continue;
    if (best == kNone || (compare_coordinate(result_.points, point, PointId{best}, static_cast<int>(axis), monitor_) >
                          0) == (up == last)) {
      best = p;
    }
  }
  return best;
}

void VertexFinder::add_interval(const SurvivingInterval& interval) {
  const FacetSegment& s = in_.intervals.segments[interval.segment];
  add_points_of(s, in_.intervals.cuts[interval.from]);
  const std::uint32_t from = nearest(s, in_.intervals.cuts[interval.from], true);
  if (interval.from == interval.to) return;
  add_points_of(s, in_.intervals.cuts[interval.to]);
  const std::uint32_t to = nearest(s, in_.intervals.cuts[interval.to], false);
  if (from == kNone || to == kNone || from == to || reach_of(s) < 100 * s.error) return;
  joints_.push_back({interval.segment, from, to});
}

void VertexFinder::add_intervals(std::size_t first, std::size_t last) {
  const std::vector<SurvivingInterval>& intervals = in_.intervals.intervals;
  for (std::size_t i = first; i < last; ++i) {
    if (i % 64 == 0) monitor_.tell_progress(kSumPhase, i, intervals.size());
    add_interval(intervals[i]);
  }
  draw_points();
}

FoundVertices VertexFinder::finish() {
  for (const RegionJoint& j : joints_) {
    const std::uint32_t from = known(j.from).vertex;
    const std::uint32_t to = known(j.to).vertex;
    if (from != kNone && to != kNone) result_.joints.push_back({j.segment, from, to});
  }
  return std::move(result_);
}

}  // namespace nef::minkowski
