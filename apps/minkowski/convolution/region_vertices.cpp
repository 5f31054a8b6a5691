// SPDX-License-Identifier: Apache-2.0
//
// Each end of an interval is a corner of a facet, a crossing of a side with a facet, or a point where three facets
// meet; which of these it is may be unsure, and then all of them are candidates. Candidates are found exactly and known
// by their number, so that each is drawn once, in batches on several threads: all facets that hold it, as an
// arrangement on a sphere, with the regions behind them marked. Points at which every region is inside are dropped.
// Where many facets meet in a point or along a line, so do all pairs of them, but only the first one looks for
// candidates there: that a known point is the only one at an end, or that a known line is that of another pair, is told
// exactly, by the facets that contain points. Sums that need not be closed also look at saddle points and at places
// where facets are not in general position.
#include "apps/minkowski/convolution/region_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>

#include "apps/minkowski/cells/meeting_points.h"
#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"
#include "apps/minkowski/convolution/known_places.h"
#include "apps/minkowski/convolution/marks/boundary_marker.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/threads/parallel.h"

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

class VertexFinder {
 public:
  VertexFinder(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree, FacetPyramids& pyramids,
               const SurvivingIntervals& intervals, const SumMembership& membership, const Monitor& monitor)
      : facets_(facets),
        rounded_(rounded),
        intervals_(intervals),
        tree_(tree),
        pyramids_(pyramids),
        membership_(membership),
        monitor_(monitor),
        is_closed_(facets.marks == BoundaryMarks::kAll),
        meetings_(facets.planes, facets.points),
        places_(rounded.extent()) {}

  void add_points(std::span<const SaddlePoint> saddles);
  RegionVertices finish();

 private:
  void add_interval(const SurvivingInterval& interval);
  void add_points_of(const FacetSegment& s, const SegmentCut& cut);
  [[nodiscard]] std::array<bool, 2> goes_on_from(const FacetAtPoint& f, const FacetAtPoint& g,
                                                 const FacetSegment& s) const;
  [[nodiscard]] std::uint32_t only_point_of(const FacetSegment& s, const SegmentCut& cut) const;
  [[nodiscard]] bool is_only_point(std::uint32_t point, const FacetSegment& s, const SegmentCut& cut) const;
  void add_points_beyond(std::uint32_t f, std::uint32_t g, const SegmentEnd& end);
  void look_for_points_of(const FacetSegment& s, const SegmentCut& cut, double beyond);
  void add_known_line(const FacetSegment& s, const SegmentCut& cut);
  void add_points_of_line(const FacetSegment& s, const SegmentCut& cut, KnownLine& line);
  std::vector<std::uint32_t> facets_along(const FacetSegment& s, std::span<const std::uint32_t> facets);
  void add_points_near(const FacetSegment& s, const Box& box, std::uint32_t facet);
  void add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h);
  void add_meeting_of(const std::array<PlaneId, 3>& planes);
  void add_corner(std::uint32_t corner);
  void add_point(PointId point);
  void draw_points();
  [[nodiscard]] std::uint32_t nearest(const FacetSegment& s, const SegmentCut& cut, bool last) const;
  void add_saddle_point(const SaddlePoint& saddle);
  void add_passages();
  void add_changes_of_marks();
  void add_crossings(std::uint32_t f, std::uint32_t g);
  [[nodiscard]] bool is_of_use(PointId point, SphereMapBuffer& map, const Monitor& own) const;

  ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  const SurvivingIntervals& intervals_;
  const BoxTree& tree_;
  FacetPyramids& pyramids_;
  const SumMembership& membership_;
  Monitor monitor_;
  bool is_closed_;
  bool among_passages_ = false;  // the points at hand are not ends of surviving intervals
  RegionVertices result_;        // its joints come last
  MeetingPoints meetings_;
  struct KnownPoint {
    std::uint32_t vertex = kNone;      // kNone if all is inside there
    std::vector<FacetAtPoint> facets;  // that hold it, in ascending order

    [[nodiscard]] const FacetAtPoint* find(std::uint32_t f) const {
      const auto at = std::lower_bound(facets.begin(), facets.end(), f,
                                       [](const FacetAtPoint& x, std::uint32_t y) { return x.facet < y; });
      return at != facets.end() && at->facet == f ? &*at : nullptr;
    }
  };
  std::unordered_map<std::uint32_t, KnownPoint> known_;  // point -> what is there
  PlacesOfPoints places_;                                // of these
  KnownLines known_lines_;
  struct Undrawn {
    PointId point{0};
    std::vector<FacetAtPoint> facets;
  };
  std::vector<Undrawn> undrawn_;     // points, known already, that may be vertices
  std::vector<std::uint32_t> near_;  // points at the cut at hand
  std::vector<RegionJoint> joints_;  // of points instead of vertices
};

void VertexFinder::add_corner(std::uint32_t corner) { add_point(meetings_.first_equal(PointId{corner})); }

void VertexFinder::add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h) {
  add_meeting_of({facets_.plane[f], facets_.plane[g], facets_.plane[h]});
}

void VertexFinder::add_meeting_of(const std::array<PlaneId, 3>& planes) {
  const std::optional<Meeting> meeting = meetings_.meet(planes);
  if (meeting) add_point(meeting->point);
}

void VertexFinder::add_point(PointId point) {
  near_.push_back(point.index());
  const auto [at, is_new] = known_.emplace(point.index(), KnownPoint());
  if (!is_new) return;
  ++result_.points;
  KnownPoint& known = at->second;
  const std::vector<FacetAtPoint>& facets = pyramids_.facets_at(point);
  known.facets = facets;
  std::sort(known.facets.begin(), known.facets.end(),
            [](const FacetAtPoint& f, const FacetAtPoint& g) { return f.facet < g.facet; });
  places_.add(facets_.points.approximate(point), point.index());
  // Where marks are mixed, a corner in the middle of another facet may be a vertex.
  if (facets.size() < (facets_.marks == BoundaryMarks::kMixed ? 1 : 3)) return;
  undrawn_.push_back({point, facets});
  constexpr std::size_t kManyPoints = 4096;
  if (undrawn_.size() >= kManyPoints) draw_points();
}

// What is put off so that several threads have something to do.
void VertexFinder::draw_points() {
  constexpr std::size_t kChunk = 64;
  std::vector<std::optional<RegionVertex>> drawn(undrawn_.size());
  parallel_for((undrawn_.size() + kChunk - 1) / kChunk, monitor_, [&](std::size_t chunk, const Monitor& own) {
    PyramidDrawer drawer(facets_, pyramids_, own);
    InsideSearch inside(membership_, own);
    for (std::size_t i = chunk * kChunk; i < std::min(undrawn_.size(), (chunk + 1) * kChunk); ++i) {
      if (inside.has(near_point(facets_.points, undrawn_[i].point))) continue;
      SphereMapBuffer map = drawer.draw(undrawn_[i].facets, undrawn_[i].point);
      if (!is_of_use(undrawn_[i].point, map, own)) continue;
      const bool plain = is_closed_ && is_plain(facets_.planes, map.view(), own);
      drawn[i] = RegionVertex{undrawn_[i].point, std::move(map), false, plain};
    }
  });
  for (std::size_t i = 0; i < undrawn_.size(); ++i) {
    if (!drawn[i]) continue;
    known_.at(undrawn_[i].point.index()).vertex = static_cast<std::uint32_t>(result_.vertices.size());
    result_.vertices.push_back(*std::move(drawn[i]));
  }
  undrawn_.clear();
}

// True if the sum may have a vertex at a point. Marks regions that are inside.
bool VertexFinder::is_of_use(PointId point, SphereMapBuffer& map, const Monitor& own) const {
  const bool open = mark_inside(map);
  if (is_closed_ || (open && !among_passages_)) return open;
  if (!open && !BoundaryMarker::may_have_passages(map.view())) return false;
  return !membership_.surely_in_inside(facets_.points.rational(point), own);
}

// Before all others but ends of intervals. Whether the sum has a vertex there is not to be seen from facets.
void VertexFinder::add_saddle_point(const SaddlePoint& saddle) {
  const PointId point = meetings_.first_equal(facets_.points.push(saddle.point));
  near_.clear();
  add_point(point);
  draw_points();
  KnownPoint& known = known_.at(point.index());
  if (known.vertex == kNone) {
    SphereMapBuffer map = PyramidDrawer(facets_, pyramids_, monitor_).draw(pyramids_.facets_at(point), point);
    mark_inside(map);
    known.vertex = static_cast<std::uint32_t>(result_.vertices.size());
    result_.vertices.push_back({point, std::move(map), true, false});
  }
  RegionVertex& v = result_.vertices[known.vertex];
  v.is_saddle_point = true;
  if (saddle.mark != 0) v.map.mark |= kInSum;
}

// Points around passages: where facets are not in general position.
void VertexFinder::add_passages() {
  among_passages_ = true;
  for (const auto& [segment, cut] : intervals_.doubtful) {
    add_points_of(intervals_.segments[segment], intervals_.cuts[cut]);
  }
  for (const std::uint32_t corner : intervals_.touching) add_corner(corner);
  if (facets_.marks == BoundaryMarks::kMixed) add_changes_of_marks();
  tree_.for_each_pair([&](std::uint32_t f, std::uint32_t g) {
    if (facets_.plane[f].row() != facets_.plane[g].row()) return;
    if (facets_.marks == BoundaryMarks::kMixed || facets_.plane[f] != facets_.plane[g]) add_crossings(f, g);
  });
}

// Corners at which the marks along the border of a facet change: where that is straight, no segment ends there.
void VertexFinder::add_changes_of_marks() {
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    const std::uint32_t begin = facets_.begin[f];
    const std::uint32_t end = facets_.begin[f + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint8_t mark = facets_.corner_marks[i];
      const std::uint8_t before = facets_.side_marks[i > begin ? i - 1 : end - 1];
      if (mark != before || mark != facets_.side_marks[i]) add_corner(facets_.corners[i]);
    }
  }
}

// The corners of two facets in one plane that the other one holds, and where their sides cross.
void VertexFinder::add_crossings(std::uint32_t f, std::uint32_t g) {
  const auto ring = facets_.ring(f);
  const auto other = facets_.ring(g);
  const auto box_of = [&](std::span<const std::uint32_t> corners, std::size_t i) {
    Box box;
    box.add_rounded(facets_.rounded[corners[i]]);
    box.add_rounded(facets_.rounded[corners[i + 1 < corners.size() ? i + 1 : 0]]);
    return box;
  };
  for (const std::uint32_t corner : ring) {
    if (pyramids_.holds(g, PointId{corner})) add_corner(corner);
  }
  for (const std::uint32_t corner : other) {
    if (pyramids_.holds(f, PointId{corner})) add_corner(corner);
  }
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const Box side = box_of(ring, i);
    for (std::uint32_t j = 0; j < other.size(); ++j) {
      if (!side.overlaps(box_of(other, j))) continue;
      add_meeting_of({facets_.plane[f], pyramids_.side_plane(f, i), pyramids_.side_plane(g, j)});
    }
  }
}

// The points where the facet beyond a side may meet the segment's facets. Where marks are mixed, also where the segment
// crosses the side itself: the side, or what is beyond it in the same plane, may be marked otherwise, and no three of
// the planes tell of that.
void VertexFinder::add_points_beyond(std::uint32_t f, std::uint32_t g, const SegmentEnd& end) {
  for (const std::uint32_t h : intervals_.at_side.at(side_key(facets_, end.facet, end.index))) add_meeting(f, g, h);
  if (facets_.marks != BoundaryMarks::kMixed) return;
  add_meeting_of({facets_.plane[f], facets_.plane[g], pyramids_.side_plane(end.facet, end.index)});
}

// Corners and sides of a facet near a cut of a segment, which is in a box.
void VertexFinder::add_points_near(const FacetSegment& s, const Box& box, std::uint32_t facet) {
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

// Whether the segment of two facets goes on from a point of both, towards its start and towards its end.
std::array<bool, 2> VertexFinder::goes_on_from(const FacetAtPoint& f, const FacetAtPoint& g,
                                               const FacetSegment& s) const {
  Direction d = Direction::cross(facets_.planes, facets_.plane[s.f], facets_.plane[s.g]);
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += d.approximate[i] * (s.to[i] - s.from[i]);
  if (along > 0) d = d.negated();
  const auto both_go = [&](const Direction& to) { return pyramids_.goes_on(f, to) && pyramids_.goes_on(g, to); };
  return {both_go(d), both_go(d.negated())};
}

// True if nothing of a segment at a cut can be a vertex but this point: both facets hold it, and it is all of the
// segment; or the segment goes through it or ends there, and each facet that cuts holds the point, and surely no other
// of the segment's line.
bool VertexFinder::is_only_point(std::uint32_t point, const FacetSegment& s, const SegmentCut& cut) const {
  const auto known = known_.find(point);
  if (known == known_.end()) return false;
  const FacetAtPoint* f = known->second.find(s.f);
  const FacetAtPoint* g = known->second.find(s.g);
  if (f == nullptr || g == nullptr) return false;
  if (cut.is_end[0] || cut.is_end[1]) {
    const std::array<bool, 2> goes_on = goes_on_from(*f, *g, s);
    if (!goes_on[0] && !goes_on[1]) return true;
    if ((cut.is_end[0] && goes_on[0]) || (cut.is_end[1] && goes_on[1])) return false;
  }
  return std::all_of(intervals_.cutting.begin() + cut.first, intervals_.cutting.begin() + cut.last,
                     [&](std::uint32_t h) {
                       if (known->second.find(h) == nullptr) return false;
                       const FormOnSegment form(rounded_.plane(h), s);
                       return std::fabs(form.slope) > 2 * form.error;
                     });
}

// A point that is known already and the only one at a cut. Where many facets meet in a point, so do as many segments as
// pairs of them, and only the first of these has to look for it. kNone if that is not sure. Not where marks are mixed:
// there a side may count that is in the plane of one of the facets.
std::uint32_t VertexFinder::only_point_of(const FacetSegment& s, const SegmentCut& cut) const {
  if (facets_.marks == BoundaryMarks::kMixed) return kNone;
  for (const std::uint32_t point : places_.near(s.box_of({std::max(cut.at.low, 0.0), std::min(cut.at.high, 1.0)}))) {
    if (is_only_point(point, s, cut)) return point;
  }
  return kNone;
}

void VertexFinder::add_points_of(const FacetSegment& s, const SegmentCut& cut) {
  near_.clear();
  if (const std::uint32_t point = only_point_of(s, cut); point != kNone) {
    near_.push_back(point);
    return;
  }
  if (facets_.marks == BoundaryMarks::kMixed || !cut.is_end[0] || !cut.is_end[1]) {
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
    const std::uint32_t h = intervals_.cutting[i];
    if (std::find(line.facets.begin(), line.facets.end(), h) != line.facets.end()) continue;
    add_meeting(s.f, s.g, h);
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
  line.facets.insert(line.facets.end(), intervals_.cutting.begin() + cut.first, intervals_.cutting.begin() + cut.last);
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
    const KnownPoint& here = known_.at(p);
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
  const Box box = widened(s.box_of({std::max(cut.at.low, 0.0), std::min(cut.at.high, 1.0)}), beyond);
  add_points_near(s, box, s.f);
  add_points_near(s, box, s.g);
  for (std::uint32_t i = cut.first; i < cut.last; ++i) add_points_near(s, box, intervals_.cutting[i]);
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
    const double t = (facets_.points.approximate(point)[axis] - s.from[axis]) / length;
    if (!(t >= cut.at.low - doubt && t <= cut.at.high + doubt)) continue;
    const KnownPoint& here = known_.at(p);
    if (here.find(s.f) == nullptr || here.find(s.g) == nullptr) continue;
    if (best == kNone || (compare_coordinate(facets_.points, point, PointId{best}, static_cast<int>(axis), monitor_) >
                          0) == (up == last)) {
      best = p;
    }
  }
  return best;
}

void VertexFinder::add_interval(const SurvivingInterval& interval) {
  const FacetSegment& s = intervals_.segments[interval.segment];
  add_points_of(s, intervals_.cuts[interval.from]);
  const std::uint32_t from = nearest(s, intervals_.cuts[interval.from], true);
  if (interval.from == interval.to) return;
  add_points_of(s, intervals_.cuts[interval.to]);
  const std::uint32_t to = nearest(s, intervals_.cuts[interval.to], false);
  if (from == kNone || to == kNone || from == to || reach_of(s) < 100 * s.error) return;
  joints_.push_back({interval.segment, from, to});
}

void VertexFinder::add_points(std::span<const SaddlePoint> saddles) {
  for (std::size_t i = 0; i < intervals_.intervals.size(); ++i) {
    if (i % 64 == 0) monitor_.tell_progress(kSumPhase, i, intervals_.intervals.size());
    add_interval(intervals_.intervals[i]);
  }
  draw_points();
  for (const SaddlePoint& saddle : saddles) add_saddle_point(saddle);
  if (!is_closed_) add_passages();
  draw_points();
}

RegionVertices VertexFinder::finish() {
  for (const RegionJoint& j : joints_) {
    const std::uint32_t from = known_.at(j.from).vertex;
    const std::uint32_t to = known_.at(j.to).vertex;
    if (from != kNone && to != kNone) result_.joints.push_back({j.segment, from, to});
  }
  return std::move(result_);
}

}  // namespace

RegionVertices region_vertices(ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree,
                               FacetPyramids& pyramids, const SurvivingIntervals& intervals,
                               const SumMembership& membership, std::span<const SaddlePoint> saddles,
                               const Monitor& monitor) {
  VertexFinder finder(facets, rounded, tree, pyramids, intervals, membership, monitor);
  finder.add_points(saddles);
  return finder.finish();
}

}  // namespace nef::minkowski
