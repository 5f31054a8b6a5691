// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/convolution_regions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/minkowski/convolution/marks/direction_into.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
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
                                       const SurvivingIntervals& intervals, const SumMembership& membership,
                                       unsigned threads)
    : facets_(facets),
      intervals_(intervals),
      tree_(rounded.boxes()),
      pyramids_(facets, rounded, tree_),
      membership_(membership),
      threads_(threads),
      marker_(pyramids_, facets),
      is_closed_(facets.marks == BoundaryMarks::kAll),
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
  // Where marks are mixed, a corner in the middle of another facet may be a vertex.
  if (facets.size() < (facets_.marks == BoundaryMarks::kMixed ? 1 : 3)) return;
  undrawn_.push_back({point, facets});
  constexpr std::size_t kManyPoints = 4096;
  if (undrawn_.size() >= kManyPoints) draw_points();
}

// What is put off so that several threads have something to do.
void ConvolutionRegions::draw_points() {
  constexpr std::size_t kChunk = 64;
  std::vector<std::optional<SphereMapBuffer>> maps(undrawn_.size());
  parallel_for((undrawn_.size() + kChunk - 1) / kChunk, threads_, [&](std::size_t chunk) {
    PyramidDrawer drawer(facets_, pyramids_);
    for (std::size_t i = chunk * kChunk; i < std::min(undrawn_.size(), (chunk + 1) * kChunk); ++i) {
      SphereMapBuffer map = drawer.draw(undrawn_[i].facets, undrawn_[i].point);
      if (is_of_use(undrawn_[i].point, map)) maps[i] = std::move(map);
    }
  });
  for (std::size_t i = 0; i < undrawn_.size(); ++i) {
    if (!maps[i]) continue;
    known_.at(undrawn_[i].point.index()).vertex = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back({undrawn_[i].point, *std::move(maps[i]), 0, false});
  }
  undrawn_.clear();
}

// True if the sum may have a vertex at a point. Marks regions that are inside.
bool ConvolutionRegions::is_of_use(PointId point, SphereMapBuffer& map) const {
  const bool open = mark_inside(map);
  if (is_closed_ || (open && !among_passages_)) return open;
  if (!open && !BoundaryMarker::may_have_passages(map.view())) return false;
  return !membership_.surely_in_inside(facets_.points.rational(point));
}

// Before all others but ends of intervals. Whether the sum has a vertex there is not to be seen from facets.
void ConvolutionRegions::add_saddle_point(const SaddlePoint& saddle) {
  const PointId point = meetings_.first_equal(facets_.points.push(saddle.point));
  near_.clear();
  add_point(point);
  draw_points();
  KnownPoint& known = known_.at(point.index());
  if (known.vertex == kNone) {
    SphereMapBuffer map = PyramidDrawer(facets_, pyramids_).draw(pyramids_.facets_at(point), point);
    mark_inside(map);
    known.vertex = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back({point, std::move(map), 0, true});
  }
  Vertex& v = vertices_[known.vertex];
  v.is_saddle_point = true;
  if (saddle.mark != 0) v.map.mark |= kInSum;
}

// Points around passages: where facets are not in general position.
void ConvolutionRegions::add_passages() {
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
void ConvolutionRegions::add_changes_of_marks() {
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
void ConvolutionRegions::add_crossings(std::uint32_t f, std::uint32_t g) {
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
      const std::optional<Meeting> meeting =
          meetings_.meet({facets_.plane[f], pyramids_.side_plane(f, i), pyramids_.side_plane(g, j)});
      if (meeting) add_point(meeting->point);
    }
  }
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
  joints_.push_back({interval.segment, from, to});
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

void ConvolutionRegions::join_regions() {
  std::uint32_t regions = 0;
  for (Vertex& v : vertices_) {
    v.first_region = regions;
    regions += static_cast<std::uint32_t>(v.map.sfaces.size());
  }
  regions_.reset(regions);
  for (const Joint& j : joints_) {
    const std::uint32_t from = known_.at(j.from).vertex;
    const std::uint32_t to = known_.at(j.to).vertex;
    if (from != kNone && to != kNone) join(intervals_.segments[j.segment], vertices_[from], vertices_[to]);
  }
}

// For each region around a vertex whether it is inside.
std::vector<std::uint8_t> ConvolutionRegions::find_inside(const std::function<void(double)>& poll) {
  enum : std::uint8_t { kOut, kIn, kUnknown, kAsked };
  std::vector<std::uint8_t> state(regions_.size(), kUnknown);
  for (const Vertex& v : vertices_) {
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      if (v.map.sfaces[f].mark != 0) state[regions_.find(v.first_region + f)] = kIn;
    }
  }
  struct Question {
    std::uint32_t region = 0;
    Rational3 point;
  };
  std::vector<Question> questions;
  for (const Vertex& v : vertices_) {
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) {
      const std::uint32_t region = regions_.find(v.first_region + f);
      if (state[region] != kUnknown) continue;
      state[region] = kAsked;
      const Direction into =
          v.map.view().trivial() ? Direction::exact(1, 0, 0) : direction_into(facets_.planes, v.map.view(), f);
      questions.push_back({region, pyramids_.point_towards(v.point, into)});
    }
  }
  constexpr std::size_t kBlock = 64;
  for (std::size_t first = 0; first < questions.size(); first += kBlock) {
    poll(static_cast<double>(first) / static_cast<double>(questions.size()));
    parallel_for(std::min(kBlock, questions.size() - first), threads_, [&](std::size_t k) {
      const Question& q = questions[first + k];
      state[q.region] = membership_.in_closure(q.point) ? kIn : kOut;
    });
  }
  counts_.tested += questions.size();
  for (std::uint32_t r = 0; r < state.size(); ++r) state[r] = state[regions_.find(r)];
  return state;
}

void ConvolutionRegions::add_points(std::span<const SaddlePoint> saddles, const std::function<void(double)>& poll) {
  for (std::size_t i = 0; i < intervals_.intervals.size(); ++i) {
    if (i % 64 == 0) poll(static_cast<double>(i) / static_cast<double>(intervals_.intervals.size()));
    add_interval(intervals_.intervals[i]);
  }
  draw_points();
  for (const SaddlePoint& saddle : saddles) add_saddle_point(saddle);
  if (!is_closed_) add_passages();
  draw_points();
}

// All items around all vertices.
void ConvolutionRegions::mark_boundary(const std::vector<std::uint8_t>& inside,
                                       const std::function<void(double)>& poll) {
  for (Vertex& v : vertices_) {
    for (std::uint32_t f = 0; f < v.map.sfaces.size(); ++f) v.map.sfaces[f].mark = inside[v.first_region + f];
    if (is_closed_) {
      for (SHalfedge& e : v.map.shalfedges) e.mark = 1;
      for (SLoop& l : v.map.sloops) l.mark = 1;
      for (SVertex& s : v.map.svertices) s.mark = 1;
      v.map.mark = 1;
    } else {
      marker_.mark(v.point, v.is_saddle_point, v.map);
    }
  }
  marker_.answer(membership_, threads_, poll);
  counts_.tested += marker_.tested();
}

std::variant<Complex, Defect> ConvolutionRegions::run(std::span<const SaddlePoint> saddles,
                                                      const std::function<void(double)>& poll) {
  // Shares of the time are measured, for the bar only.
  add_points(saddles, [&poll](double share) { poll(0.4 * share); });
  join_regions();
  const std::vector<std::uint8_t> inside = find_inside([&poll](double share) { poll(0.4 + 0.4 * share); });
  mark_boundary(inside, [&poll](double share) { poll(0.8 + 0.15 * share); });
  ComplexBuilder builder(facets_.planes);
  Arrangement drawing;
  for (const Vertex& v : vertices_) {
    const auto is_inside = [](const SFace& f) { return f.mark != 0; };
    if (is_closed_ && std::all_of(v.map.sfaces.begin(), v.map.sfaces.end(), is_inside)) continue;
    drawing.load(facets_.planes, v.map.view());
    builder.add(facets_.points, v.point, drawing);
  }
  std::variant<Complex, Defect> sum = builder.try_finish(0);
  poll(1);
  return sum;
}

}  // namespace nef::minkowski
