// SPDX-License-Identifier: Apache-2.0
//
// 1. A tree of boxes gives pairs of facets, and `SegmentFinder` their segments.
// 2. Each segment is cut where a facet meets both of its facets; cuts that are not surely apart are one cut.
// 3. At a cut, the part of the segment that a facet has behind it is gone. So are parts in cubes that are surely
// inside.
// 4. Three facets that cross link the intervals in front of all three; a queue removes those that are linked to a gone
//    one (`remove_linked`).
//
// Steps 1 and 2 work on blocks of pairs and segments, on several threads, and results are put together in order.
#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "apps/minkowski/convolution/arrangement/linked_intervals.h"
#include "apps/minkowski/convolution/arrangement/meeting_facets.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

// Where a facet meets a segment.
struct Event {
  Interval at;
  std::uint32_t facet = kNone;
  int front = 0;  // the facet surely crosses, its front towards the end (1) or the start (-1) of the segment; else 0
  bool is_at_end = false;  // the facet surely holds no point of the segment but maybe one of its ends
};

// What comes of cutting a run of segments; numbers of cuts and intervals, and places in `cutting`, count from its
// start.
struct CutSegments {
  std::vector<SegmentCut> cuts;
  std::vector<std::uint32_t> cutting;
  std::vector<SurvivingInterval> intervals;
  std::vector<std::array<std::uint32_t, 2>> doubtful;
  std::vector<IntervalLink> links;
};

// Cuts segments. Not to be shared between threads.
class SegmentCutter {
 public:
  // All must outlive the object.
  SegmentCutter(const ConvolutionFacets& facets, const RoundedFacets& rounded,
                const std::vector<FacetSegment>& segments, const SharedSides& at_side, const MeetingFacets& meeting,
                const SumMembership& membership, bool passages, const Monitor& monitor)
      : facets_(facets),
        rounded_(rounded),
        segments_(segments),
        at_side_(at_side),
        meeting_(meeting),
        passages_(passages),
        inside_(membership, monitor) {}

  CutSegments run(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) cut(static_cast<std::uint32_t>(i));
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_corner(std::uint32_t facet, std::uint32_t corner) const {
    const auto ring = facets_.ring(facet);
    return std::find(ring.begin(), ring.end(), corner) != ring.end();
  }

  // True if the end of a segment is known to lie on a facet: at a corner or on a side of it.
  [[nodiscard]] bool ends_on(const SegmentEnd& end, std::uint32_t h) const {
    if (end.kind == SegmentEnd::Kind::kCorner) return has_corner(h, end.index);
    if (end.kind == SegmentEnd::Kind::kUnsure) return false;
    const std::span<const std::uint32_t> same = at_side_(end.facet, end.index);
    return std::find(same.begin(), same.end(), h) != same.end();
  }

  // Whether a point of the plane of a facet, within an error, is surely inside (1), surely outside (-1) of it.
  [[nodiscard]] int place_in(std::uint32_t h, const Double3& x, double error) const {
    int place = 1;
    for (const RoundedSide& side : rounded_.sides(h)) {
      const double value = side.value(x);
      const double doubt = side.slack + side.weight * error;
      if (value < -doubt) return -1;
      if (!(value > doubt)) place = 0;
    }
    return place;
  }

  // Where facet h meets a segment, if it may beyond the segment's ends. One of the segment's facets has nothing in
  // front of h if `is_behind`: then the segment has at most one end in the plane of h, or all of it.
  [[nodiscard]] std::optional<Event> event(const FacetSegment& s, std::uint32_t h, bool is_behind) const {
    const FormOnSegment form(rounded_.plane(h), s);
    const double last = form.at + form.slope;
    const bool start_off = std::fabs(form.at) > form.error;
    const bool end_off = std::fabs(last) > form.error;
    if (start_off && end_off && (form.at > 0) == (last > 0)) return std::nullopt;
    if (!(start_off && end_off)) {
      // Known ends are exactly on the plane, so there is nothing between them and the other end.
      const bool on_start = ends_on(s.ends[0], h);
      const bool on_end = ends_on(s.ends[1], h);
      if ((on_start && on_end) || (on_start && end_off) || (on_end && start_off)) return std::nullopt;
      return touching(s, h, form, is_behind && (start_off || end_off));
    }
    const double t = form.at / (form.at - last);
    // Both ends are surely off the plane, so 0 < t < 1: the forms' errors move it by less than twice their part of the
    // slope, and what rounds in it is a few units of 2^-53, a thousandth of the last term.
    const double doubt = form.error / std::fabs(form.slope) * 2 + 1e-13;
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, std::fabs(s.to[i] - s.from[i]));
    const int place = place_in(h, s.at(t), s.error + doubt * reach + rounded_.corner_error());
    if (place < 0) return std::nullopt;
    return Event{{t - doubt, t + doubt}, h, place == 0 ? 0 : form.slope > 0 ? 1 : -1};
  }

  // The same where the segment may be in the plane of h or end there.
  [[nodiscard]] std::optional<Event> touching(const FacetSegment& s, std::uint32_t h, const FormOnSegment& form,
                                              bool is_at_end) const {
    Event event;
    event.facet = h;
    event.is_at_end = is_at_end;
    keep_below(event.at, form.at, form.slope, form.error, Rounding::kOutwards);
    keep_below(event.at, -form.at, -form.slope, form.error, Rounding::kOutwards);
    for (const RoundedSide& side : rounded_.sides(h)) {
      const double from = side.value(s.from);
      const double slope = side.value(s.to) - from;
      const double doubt = 2 * (side.slack + side.weight * s.error);
      keep_below(event.at, -from, -slope, doubt, Rounding::kOutwards);
    }
    if (!(event.at.low <= event.at.high)) return std::nullopt;
    return event;
  }

  void find_events(const FacetSegment& s) {
    events_.clear();
    const Box box = s.box();
    const auto look_at = [&](const MeetingFacets::Other& h) {
      if (!box.overlaps(rounded_.box(h.facet))) return;
      if (const std::optional<Event> e = event(s, h.facet, h.is_behind)) events_.push_back(*e);
    };
    // What meets the segment meets both facets; but facets in the plane of one have segments with the other one only.
    const bool few_on_f = meeting_(s.f).size() < meeting_(s.g).size();
    const std::uint32_t few = few_on_f ? s.f : s.g;
    const std::uint32_t many = few_on_f ? s.g : s.f;
    for (const MeetingFacets::Other& h : meeting_(few)) {
      if (h.facet != many) look_at(h);
    }
    for (const MeetingFacets::Other& h : meeting_(many)) {
      if (h.facet != few && facets_.plane[h.facet].row() == facets_.plane[few].row()) look_at(h);
    }
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at.low < b.at.low; });
  }

  // What is known about the part of a segment before or after a cut.
  struct Side {
    bool gone = false;
    bool linked = false;
    IntervalLink link;
  };
  struct Cut {
    Interval at;
    std::uint32_t first = 0, last = 0;  // events
    std::array<bool, 2> is_end{};
    std::array<Side, 2> side;  // before, after
  };

  void cut(std::uint32_t segment) {
    const FacetSegment& s = segments_[segment];
    if (!s.faces_a_region && !s.is_side_of_both && !passages_) return;
    find_events(s);
    find_cuts(s);
    for (Cut& cut : cuts_) judge(s, cut);
    std::vector<std::uint32_t> number(cuts_.size(), kNone);
    const auto number_of = [&](std::size_t i) {
      if (number[i] == kNone) {
        number[i] = static_cast<std::uint32_t>(result_.cuts.size());
        const auto first = static_cast<std::uint32_t>(result_.cutting.size());
        for (std::uint32_t e = cuts_[i].first; e < cuts_[i].last; ++e) result_.cutting.push_back(events_[e].facet);
        result_.cuts.push_back(
            {first, static_cast<std::uint32_t>(result_.cutting.size()), cuts_[i].is_end, cuts_[i].at});
      }
      return number[i];
    };
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      const bool is_doubtful = passages_ && !is_plain(s, cuts_[i]);
      const bool has_intervals = s.faces_a_region && may_hold_intervals(cuts_[i]);
      if (!(is_doubtful || has_intervals) || is_covered(s, cuts_[i])) continue;
      const std::uint32_t here = number_of(i);
      if (is_doubtful) result_.doubtful.push_back({segment, here});
      if (has_intervals) result_.intervals.push_back({segment, here, here});
    }
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      Side& after = cuts_[i].side[1];
      Side& before = cuts_[i + 1].side[0];
      std::uint32_t interval = kNone;
      if (s.faces_a_region && !after.gone && !before.gone && !is_covered(s, cuts_[i], cuts_[i + 1])) {
        interval = static_cast<std::uint32_t>(result_.intervals.size());
        const std::uint32_t from = number_of(i);
        result_.intervals.push_back({segment, from, number_of(i + 1)});
      }
      for (Side* side : {&after, &before}) {
        if (!side->linked) continue;
        side->link.interval = interval;
        result_.links.push_back(side->link);
      }
    }
  }

  // True if all that is between the points of a cut is surely in the inside of the sum.
  [[nodiscard]] bool is_covered(const FacetSegment& s, const Cut& cut) {
    const std::array<Double3, 2> ends = {s.at(std::max(cut.at.low, 0.0)), s.at(std::min(cut.at.high, 1.0))};
    return facets_.covered.cover(ends, s.error) || is_in_inside(ends, s.error);
  }

  // The same for the interval between two cuts, which nothing cuts: if one of its points is inside, all are.
  [[nodiscard]] bool is_covered(const FacetSegment& s, const Cut& from, const Cut& to) {
    if (!(from.at.high < to.at.low)) return false;
    const double first = std::max(from.at.high, 0.0);
    const Double3 middle = s.at(first + kShare * (std::min(to.at.low, 1.0) - first));
    return facets_.covered.cover({&middle, 1}, s.error) || is_in_inside({middle, middle}, s.error);
  }

  // At the middle parts with faces in parallel planes may touch.
  static constexpr double kShare = 0.381966;

  // True if A and x - B surely have their insides in common for all x of a segment, whose ends are within `error`.
  bool is_in_inside(const std::array<Double3, 2>& ends, double error) {
    Approximation3 x;
    for (std::size_t i = 0; i < 3; ++i) {
      // The rounding of the middle and of the half is far below 8u of both ends.
      x[i].value = (ends[0][i] + ends[1][i]) / 2;
      x[i].error =
          std::fabs(ends[1][i] - ends[0][i]) / 2 + error + 8 * kUnit * (std::fabs(ends[0][i]) + std::fabs(ends[1][i]));
    }
    return inside_.has(x);
  }

  // True if what lies between the points of a cut need not be behind a facet. It is, in whatever order they come, if
  // all facets cross the segment the same way. Facets that hold an end at most cut nothing off.
  [[nodiscard]] bool may_hold_intervals(const Cut& cut) const {
    if (cut.is_end[0] && cut.is_end[1]) return true;
    if (cut.first == cut.last) return false;
    const int front = events_[cut.first].front;
    if (cut.is_end[0] || cut.is_end[1]) {
      return !std::all_of(events_.begin() + cut.first, events_.begin() + cut.last,
                          [](const Event& e) { return e.is_at_end; });
    }
    if (front == 0) return true;
    for (std::uint32_t i = cut.first; i < cut.last; ++i) {
      if (events_[i].front != front) return true;
    }
    return false;
  }

  // True if the facets at a cut are surely in general position: one facet crosses the segment inside of all three; or
  // the segment ends where a side of one facet crosses the inside of the other one, or at a corner that they share.
  [[nodiscard]] bool is_plain(const FacetSegment& s, const Cut& cut) const {
    const std::uint32_t count = cut.last - cut.first;
    if (!cut.is_end[0] && !cut.is_end[1]) return count == 1 && events_[cut.first].front != 0;
    if (count > 0 || cut.is_end[0] == cut.is_end[1]) return false;
    const SegmentEnd& end = s.ends[cut.is_end[0] ? 0 : 1];
    if (end.kind == SegmentEnd::Kind::kSide) return true;
    return end.kind == SegmentEnd::Kind::kCorner && has_corner(s.f, end.index) && has_corner(s.g, end.index);
  }

  // Groups events that are not surely apart.
  void find_cuts(const FacetSegment& s) {
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, std::fabs(s.to[i] - s.from[i]));
    const double doubt = reach > 2 * s.error ? 2 * s.error / reach : 1;
    cuts_.clear();
    cuts_.push_back({{-1, doubt}, 0, 0, {true, false}, {}});
    for (std::uint32_t i = 0; i < events_.size(); ++i) {
      if (events_[i].at.low > cuts_.back().at.high) cuts_.push_back({events_[i].at, i, i, {}, {}});
      cuts_.back().at.high = std::max(cuts_.back().at.high, events_[i].at.high);
      cuts_.back().last = i + 1;
    }
    if (1 - doubt > cuts_.back().at.high) {
      const auto end = static_cast<std::uint32_t>(events_.size());
      cuts_.push_back({{1 - doubt, 2}, end, end, {}, {}});
    }
    cuts_.back().is_end[1] = true;
  }

  void judge(const FacetSegment& s, Cut& cut) const {
    const bool is_end = cut.is_end[0] || cut.is_end[1];
    const std::uint32_t count = cut.last - cut.first;
    if (count == 0 && cut.is_end[0] != cut.is_end[1]) {
      judge_end(s, cut, cut.is_end[1] ? 0 : 1);
      return;
    }
    for (const std::size_t k : {0U, 1U}) {
      // The part behind is gone if, whatever the order, the last facet on the way there has it behind it.
      const int front = k == 0 ? 1 : -1;
      for (std::uint32_t i = cut.first; i < cut.last && !cut.side[k].gone; ++i) {
        if (events_[i].front != front) continue;
        cut.side[k].gone = true;
        for (std::uint32_t j = cut.first; j < cut.last; ++j) {
          const bool may_follow =
              k == 0 ? events_[j].at.low <= events_[i].at.high : events_[j].at.high >= events_[i].at.low;
          if (may_follow && events_[j].front != front) cut.side[k].gone = false;
        }
        if (is_end) cut.side[k].gone = false;
      }
    }
    if (count != 1 || is_end || events_[cut.first].front == 0) return;
    const std::size_t ahead = events_[cut.first].front > 0 ? 1 : 0;
    cut.side[ahead].linked = true;
    cut.side[ahead].link.at = sorted(s.f, s.g, events_[cut.first].facet);
  }

  // A segment that ends inside of one facet, at a side of the other one, goes on on the facet beyond that side.
  void judge_end(const FacetSegment& s, Cut& cut, std::size_t side) const {
    const SegmentEnd& end = s.ends[cut.is_end[0] ? 0 : 1];
    if (end.kind != SegmentEnd::Kind::kSide) return;
    const std::span<const std::uint32_t> same = at_side_(end.facet, end.index);
    if (same.size() == 1) cut.side[side].gone = true;  // beyond the side one comes from the front to the back
    if (same.size() != 2) return;
    const std::uint32_t beyond = same[0] == end.facet ? same[1] : same[0];
    cut.side[side].linked = true;
    cut.side[side].link.at = sorted(s.f, s.g, beyond);
    cut.side[side].link.smooth = facets_.plane[beyond] == facets_.plane[end.facet];
  }

  static std::array<std::uint32_t, 3> sorted(std::uint32_t f, std::uint32_t g, std::uint32_t h) {
    std::array<std::uint32_t, 3> t = {f, g, h};
    std::sort(t.begin(), t.end());
    return t;
  }

  const ConvolutionFacets& facets_;
  const RoundedFacets& rounded_;
  const std::vector<FacetSegment>& segments_;
  const SharedSides& at_side_;
  const MeetingFacets& meeting_;
  bool passages_;
  InsideSearch inside_;  // what is done with a chunk of segments does not depend on threads
  CutSegments result_;
  // Of the segment at hand.
  std::vector<Event> events_;
  std::vector<Cut> cuts_;
};

// Segments of pairs of facets, and corners that may touch facets.
struct FoundSegments {
  std::vector<FacetSegment> segments;
  std::vector<std::uint32_t> touching;
};

// In order.
FoundSegments joined(std::vector<FoundSegments>&& found, const Monitor& monitor) {
  std::vector<std::size_t> begin(found.size() + 1, 0);
  for (std::size_t i = 0; i < found.size(); ++i) begin[i + 1] = begin[i] + found[i].segments.size();
  FoundSegments result;
  result.segments.resize(begin.back());
  parallel_for(found.size(), for_vertices(begin.back(), monitor), [&](std::size_t i, const Monitor&) {
    std::copy(found[i].segments.begin(), found[i].segments.end(),
              result.segments.begin() + static_cast<std::ptrdiff_t>(begin[i]));
    found[i].segments = {};
  });
  for (const FoundSegments& part : found) {
    result.touching.insert(result.touching.end(), part.touching.begin(), part.touching.end());
  }
  return result;
}

FoundSegments all_segments(const ConvolutionFacets& facets, const RoundedFacets& rounded, const BoxTree& tree,
                           bool passages, const Monitor& monitor) {
  constexpr std::size_t kFacetsOfPart = 512;
  const BoxTree::PairSearch search(tree);
  const std::vector<BoxTree::PairSearch::Part> parts = search.parts(facets.size() / kFacetsOfPart + 1);
  std::vector<FoundSegments> found(parts.size());
  parallel_for(parts.size(), monitor, [&](std::size_t i, const Monitor& own) {
    SegmentFinder finder(facets, rounded, own);
    search.for_each(parts[i], [&](std::uint32_t f, std::uint32_t g) {
      if (std::optional<FacetSegment> s = finder.find(f, g)) found[i].segments.push_back(*s);
    });
    if (passages) found[i].touching = finder.touching_corners();
  });
  return joined(std::move(found), monitor);
}

void append(const CutSegments& part, CutSegments& all) {
  const auto cuts = static_cast<std::uint32_t>(all.cuts.size());
  const auto cutting = static_cast<std::uint32_t>(all.cutting.size());
  const auto intervals = static_cast<std::uint32_t>(all.intervals.size());
  for (const SegmentCut& c : part.cuts) all.cuts.push_back({c.first + cutting, c.last + cutting, c.is_end, c.at});
  all.cutting.insert(all.cutting.end(), part.cutting.begin(), part.cutting.end());
  for (const SurvivingInterval& i : part.intervals) all.intervals.push_back({i.segment, i.from + cuts, i.to + cuts});
  for (const auto& [segment, cut] : part.doubtful) all.doubtful.push_back({segment, cut + cuts});
  for (IntervalLink link : part.links) {
    if (link.interval != kNone) link.interval += intervals;
    all.links.push_back(link);
  }
}

CutSegments cut_segments(const ConvolutionFacets& facets, const RoundedFacets& rounded,
                         const std::vector<FacetSegment>& segments, const SharedSides& at_side,
                         const SumMembership& membership, bool passages, const Monitor& monitor) {
  constexpr std::size_t kChunk = 256;
  constexpr std::size_t kBlock = 64 * kChunk;
  const MeetingFacets meeting(facets.size(), segments);
  CutSegments result;
  for (std::size_t block = 0; block < segments.size(); block += kBlock) {
    monitor.tell_progress(kSumPhase, block, segments.size());
    const std::size_t end = std::min(segments.size(), block + kBlock);
    std::vector<CutSegments> parts((end - block + kChunk - 1) / kChunk);
    parallel_for(parts.size(), monitor, [&](std::size_t chunk, const Monitor& own) {
      const std::size_t first = block + chunk * kChunk;
      parts[chunk] = SegmentCutter(facets, rounded, segments, at_side, meeting, membership, passages, own)
                         .run(first, std::min(end, first + kChunk));
    });
    for (const CutSegments& part : parts) append(part, result);
  }
  return result;
}

}  // namespace

SurvivingIntervals surviving_intervals(const ConvolutionFacets& facets, const RoundedFacets& rounded,
                                       const BoxTree& tree, const SharedSides& at_side, const SumMembership& membership,
                                       bool passages, const Monitor& monitor) {
  FoundSegments found = all_segments(facets, rounded, tree, passages, monitor);
  CutSegments cut = cut_segments(facets, rounded, found.segments, at_side, membership, passages, monitor);
  remove_linked(std::move(cut.links), cut.intervals);
  return {std::move(found.segments), std::move(cut.cuts),     std::move(cut.cutting),
          std::move(cut.intervals),  std::move(cut.doubtful), std::move(found.touching)};
}

}  // namespace nef::minkowski
