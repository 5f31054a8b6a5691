// SPDX-License-Identifier: Apache-2.0
//
// The interval between two edges that cross the sweep line holds no corner to the right of its chain, so a corner at
// which the line arrives sees the last corner of the chain, and all of the chain between that one and the other edge:
// both parts of a chain turn away from the line at each of their corners, or go straight on, as what they would turn to
// it has been cut off.
//
// Several corners may lie at one point. Each stands for one sector of the polygon there, and these do not overlap; what
// ends there is done before what begins there, so that in a search no edge ends where the line is.
#include "nef/mesh/polygon/sweep_triangulation.h"

#include <algorithm>

namespace nef {

// A corner is in four cells at most, for which there is room.
inline std::uint32_t SweepTriangulator::push(std::uint32_t corner, std::uint32_t rest) {
  cells_[cell_count_] = {corner, rest};
  return cell_count_++;
}

std::uint32_t SweepTriangulator::new_interval() {
  if (free_intervals_.empty()) {
    intervals_.emplace_back();
    return static_cast<std::uint32_t>(intervals_.size() - 1);
  }
  const std::uint32_t id = free_intervals_.back();
  free_intervals_.pop_back();
  return id;
}

inline void SweepTriangulator::add_known(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  out_->push_back({corners_->point(a), corners_->point(b), corners_->point(c)});
}

inline bool SweepTriangulator::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (!corners_->turns_left(a, b, c)) return false;
  add_known(a, b, c);
  return true;
}

// Joins a corner on the edge below to the lower part of the chain, all of which it sees.
inline bool SweepTriangulator::fan_lower(const Interval& interval, std::uint32_t p) {
  Cell cell = cells_[interval.lower];
  while (cell.rest != kNone) {
    const Cell next = cells_[cell.rest];
    if (!add(p, cell.corner, next.corner)) return false;
    cell = next;
  }
  return true;
}

inline bool SweepTriangulator::fan_upper(const Interval& interval, std::uint32_t p) {
  Cell cell = cells_[interval.upper];
  while (cell.rest != kNone) {
    const Cell next = cells_[cell.rest];
    if (!add(p, next.corner, cell.corner)) return false;
    cell = next;
  }
  return true;
}

// Joins a corner to what it sees of the lower part of the chain from its beginning on. Returns what is left of that.
inline std::uint32_t SweepTriangulator::cut_lower(const Interval& interval, std::uint32_t p) {
  std::uint32_t first = interval.lower;
  while (cells_[first].rest != kNone) {
    const std::uint32_t a = cells_[first].corner;
    const std::uint32_t b = cells_[cells_[first].rest].corner;
    if (!corners_->turns_left(p, a, b)) break;
    add_known(p, a, b);
    first = cells_[first].rest;
  }
  return first;
}

inline std::uint32_t SweepTriangulator::cut_upper(const Interval& interval, std::uint32_t p) {
  std::uint32_t first = interval.upper;
  while (cells_[first].rest != kNone) {
    const std::uint32_t a = cells_[first].corner;
    const std::uint32_t b = cells_[cells_[first].rest].corner;
    if (!corners_->turns_left(p, b, a)) break;
    add_known(p, b, a);
    first = cells_[first].rest;
  }
  return first;
}

inline bool SweepTriangulator::go_on_below(std::uint32_t p) {
  const std::uint32_t id = links_[links_[p].prev].above;
  if (id == kNone) return false;
  links_[links_[p].prev].above = kNone;
  Interval& interval = intervals_[id];
  if (!fan_lower(interval, p)) return false;
  interval.upper = push(p, cut_upper(interval, p));
  interval.lower = push(p, kNone);
  interval.floor = p;
  links_[p].above = id;
  return true;
}

inline bool SweepTriangulator::go_on_above(std::uint32_t p) {
  const std::uint32_t id = links_[links_[p].next].below;
  if (id == kNone) return false;
  links_[links_[p].next].below = kNone;
  Interval& interval = intervals_[id];
  if (!fan_upper(interval, p)) return false;
  interval.lower = push(p, cut_lower(interval, p));
  interval.upper = push(p, kNone);
  interval.ceiling = p;
  links_[p].below = id;
  return true;
}

bool SweepTriangulator::end(std::uint32_t p) {
  const std::uint32_t id = links_[links_[p].prev].above;
  if (id == kNone || id != links_[links_[p].next].below) return false;
  links_[links_[p].prev].above = links_[links_[p].next].below = kNone;
  if (!fan_lower(intervals_[id], p) || !fan_upper(intervals_[id], p)) return false;
  status_.erase(id);
  free_intervals_.push_back(id);
  return true;
}

// The interval below p goes on as both.
bool SweepTriangulator::merge(std::uint32_t p) {
  const std::uint32_t low = links_[links_[p].next].below;
  const std::uint32_t high = links_[links_[p].prev].above;
  if (low == kNone || high == kNone || low == high) return false;
  links_[links_[p].next].below = links_[links_[p].prev].above = kNone;
  Interval& interval = intervals_[low];
  const Interval& other = intervals_[high];
  if (!fan_upper(interval, p) || !fan_lower(other, p)) return false;
  interval.lower = push(p, cut_lower(interval, p));
  interval.upper = push(p, cut_upper(other, p));
  interval.ceiling = other.ceiling;
  links_[interval.ceiling].below = low;
  status_.erase(high);
  free_intervals_.push_back(high);
  return true;
}

// Behind the last interval whose lower edge lies below p or, where that edge begins at p, below the edge that leaves p.
OrderedBlocks::Place SweepTriangulator::find(std::uint32_t p) {
  return status_.find([&](std::uint32_t id) {
    const std::uint32_t left = intervals_[id].floor;
    const std::uint32_t right = links_[left].next;
    const bool here = corners_->point(left) == corners_->point(p);
    const int side = corners_->turn(left, right, here ? links_[p].next : p);
    broken_ = broken_ || side == 0;
    return side > 0;
  });
}

// A corner, or a point alone, with the polygon on both sides of it.
bool SweepTriangulator::split(std::uint32_t p, Kind kind) {
  const OrderedBlocks::Place place = find(p);
  const std::uint32_t low = status_.before(place);
  if (low == kNone || broken_) return false;
  if (!corners_->turns_left(links_[intervals_[low].ceiling].prev, intervals_[low].ceiling, p)) return false;
  const std::uint32_t lower = push(p, cut_lower(intervals_[low], p));
  const std::uint32_t upper = push(p, cut_upper(intervals_[low], p));
  if (kind == Kind::kAlone) {
    intervals_[low].lower = lower;
    intervals_[low].upper = upper;
    return true;
  }
  const std::uint32_t high = new_interval();
  intervals_[high] = {p, intervals_[low].ceiling, push(p, kNone), upper};
  intervals_[low].lower = lower;
  intervals_[low].upper = push(p, kNone);
  intervals_[low].ceiling = p;
  links_[p].above = high;
  links_[p].below = low;
  links_[intervals_[high].ceiling].below = high;
  status_.insert(place, high);
  return true;
}

bool SweepTriangulator::start(std::uint32_t p) {
  const OrderedBlocks::Place place = find(p);
  if (broken_) return false;
  const std::uint32_t id = new_interval();
  const std::uint32_t cell = push(p, kNone);
  intervals_[id] = {p, p, cell, cell};
  links_[p].above = links_[p].below = id;
  status_.insert(place, id);
  return true;
}

SweepTriangulator::Kind SweepTriangulator::kind_of(std::uint32_t corner) const {
  const Links& at = links_[corner];
  if (at.next == corner) return Kind::kAlone;
  const bool from_right = links_[at.prev].rank > at.rank;
  const bool to_right = links_[at.next].rank > at.rank;
  if (from_right != to_right) return to_right ? Kind::kFloor : Kind::kCeiling;
  // Where both edges coincide, the corner is the tip of a dangling edge, with the polygon all around.
  const bool convex = corners_->turns_left(at.prev, corner, at.next);
  if (from_right) return convex ? Kind::kStart : Kind::kSplit;
  return convex ? Kind::kEnd : Kind::kMerge;
}

bool SweepTriangulator::handle(std::uint32_t corner, Kind kind) {
  switch (kind) {
    case Kind::kEnd:
      return end(corner);
    case Kind::kMerge:
      return merge(corner);
    case Kind::kFloor:
      return go_on_below(corner);
    case Kind::kCeiling:
      return go_on_above(corner);
    case Kind::kStart:
      return start(corner);
    case Kind::kSplit:
    case Kind::kAlone:
      break;
  }
  return split(corner, kind);
}

// True if from corner `at`, which none of a and b coincides with, the direction to a comes before that to b in one
// clockwise turn that begins upwards, in the lexicographic sense: directions to the right come first.
bool SweepTriangulator::clockwise_before(std::uint32_t at, std::uint32_t a, std::uint32_t b) const {
  const bool a_right = links_[a].rank > links_[at].rank;
  const bool b_right = links_[b].rank > links_[at].rank;
  if (a_right != b_right) return a_right;
  return corners_->turn(at, a, b) < 0;
}

// Rings that meet at a point are linked anew there, so that each corner has a sector of its own: going around the point
// clockwise, such a sector begins with an edge that arrives and ends with the next one that leaves. Of two edges that
// coincide with the polygon on both sides, the one that leaves comes first.
void SweepTriangulator::separate(std::span<const std::uint32_t> corners) {
  arms_.clear();
  for (const std::uint32_t c : corners) {
    if (links_[c].next == c) return;
    arms_.push_back({links_[c].prev, false});
    arms_.push_back({links_[c].next, true});
  }
  const std::uint32_t at = corners[0];
  std::sort(arms_.begin(), arms_.end(), [&](const Arm& a, const Arm& b) {
    if (clockwise_before(at, a.far, b.far)) return true;
    if (clockwise_before(at, b.far, a.far)) return false;
    return a.leaves && !b.leaves;
  });
  if (arms_[0].leaves) std::rotate(arms_.begin(), arms_.begin() + 1, arms_.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Arm& in = arms_[2 * i];
    const Arm& out = arms_[2 * i + 1];
    if (in.leaves || !out.leaves) {
      broken_ = true;
      return;
    }
    links_[corners[i]].prev = in.far;
    links_[corners[i]].next = out.far;
    links_[in.far].next = links_[out.far].prev = corners[i];
  }
}

// More than one corner at one point.
bool SweepTriangulator::reach_together(std::span<const std::uint32_t> corners) {
  separate(corners);
  if (broken_) return false;
  constexpr auto phase = [](Kind kind) {
    return kind == Kind::kStart ? 2 : kind == Kind::kSplit || kind == Kind::kAlone ? 1 : 0;
  };
  for (int i = 0; i < 3; ++i) {
    for (const std::uint32_t c : corners) {
      const Kind kind = kind_of(c);
      if (phase(kind) == i && !handle(c, kind)) return false;
    }
  }
  return true;
}

void SweepTriangulator::link(std::span<const std::uint32_t> ring_end) {
  links_.resize(corners_->size());
  std::uint32_t first = 0;
  for (const std::uint32_t last : ring_end) {
    for (std::uint32_t i = first; i < last; ++i) {
      links_[i] = {i == first ? last - 1 : i - 1, i + 1 == last ? first : i + 1, 0, kNone, kNone};
    }
    first = last;
  }
}

// Parts of rings that go to the right, and those that go to the left, turned round.
void SweepTriangulator::collect_runs(std::span<const std::uint32_t> ring_end) {
  sorted_.resize(corners_->size());
  run_end_.clear();
  std::uint32_t i = 0;
  for (const std::uint32_t last : ring_end) {
    while (i < last) {
      const std::uint32_t first = i;
      sorted_[i] = (*corners_)[i];
      ++i;
      if (i < last) {
        const bool rises = corners_->before(sorted_[first], (*corners_)[i]);
        do {
          sorted_[i] = (*corners_)[i];
          ++i;
        } while (i < last && corners_->before(sorted_[i - 1], (*corners_)[i]) == rises);
        if (!rises) std::reverse(sorted_.begin() + first, sorted_.begin() + i);
      }
      run_end_.push_back(i);
    }
  }
}

// Neighbours are merged until one is left.
template <typename Before>
void SweepTriangulator::merge_runs(Before before) {
  merged_.resize(sorted_.size());
  while (run_end_.size() > 1) {
    std::size_t kept = 0;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < run_end_.size(); i += 2) {
      const std::uint32_t middle = run_end_[i];
      const std::uint32_t last = i + 1 < run_end_.size() ? run_end_[i + 1] : middle;
      std::merge(sorted_.begin() + first, sorted_.begin() + middle, sorted_.begin() + middle, sorted_.begin() + last,
                 merged_.begin() + first, before);
      run_end_[kept++] = first = last;
    }
    run_end_.resize(kept);
    std::swap(sorted_, merged_);
  }
}

// Corners at one point have one rank.
void SweepTriangulator::sort(std::span<const std::uint32_t> ring_end) {
  using Corner = ProjectedCorners::Corner;
  collect_runs(ring_end);
  if (corners_->ordered()) {
    merge_runs([](const Corner& a, const Corner& b) { return ProjectedCorners::before_ordered(a, b); });
  } else {
    merge_runs([this](const Corner& a, const Corner& b) { return corners_->before(a, b); });
  }
  std::uint32_t rank = 0;
  for (std::uint32_t i = 0; i < sorted_.size(); ++i) {
    if (i > 0 && sorted_[i].point != sorted_[i - 1].point) rank = i;
    links_[sorted_[i].index].rank = rank;
  }
}

// The line comes to the corners of one point, from `first` up to `last`.
bool SweepTriangulator::reach(std::size_t first, std::size_t last) {
  if (last - first == 1) {
    const std::uint32_t corner = sorted_[first].index;
    return handle(corner, kind_of(corner));
  }
  here_.clear();
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t corner = sorted_[i].index;
    const Links& at = links_[corner];
    if (at.next != corner && links_[at.next].rank == at.rank) return false;
    here_.push_back(corner);
  }
  return reach_together(here_);
}

bool SweepTriangulator::triangulate(const ProjectedCorners& corners, std::span<const std::uint32_t> ring_end,
                                    std::vector<Triangle>& out) {
  corners_ = &corners;
  out_ = &out;
  broken_ = false;
  cell_count_ = 0;
  if (cells_.size() < 4 * corners.size()) cells_.resize(4 * corners.size());
  intervals_.clear();
  free_intervals_.clear();
  status_.clear();
  link(ring_end);
  sort(ring_end);
  for (std::size_t i = 0; i < sorted_.size();) {
    const std::size_t first = i++;
    while (i < sorted_.size() && sorted_[i].point == sorted_[first].point) ++i;
    if (!reach(first, i)) return false;
  }
  return status_.size() == 0;
}

}  // namespace nef
