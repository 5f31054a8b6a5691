// SPDX-License-Identifier: Apache-2.0
//
// A line moves over the sides and keeps those that it crosses in their order. Two sides cross or touch only if they are
// neighbours on the line before, and then the end that is reached first tells. Above a side around which the region
// lies the winding number is one more than below, or one less; so it is 0 or 1 everywhere if these two kinds alternate,
// from one with the region above to one with the region below.
#include "nef/mesh/polygon/plain_border.h"

#include <algorithm>

namespace nef {

bool PlainBorder::surrounds_once(std::span<const Side> sides, std::size_t axis, int turn, const Monitor& monitor) {
  axis_ = axis;
  monitor_ = monitor;
  if (!sort(sides)) return false;
  list_segments(sides, turn);
  status_.clear();
  for (std::uint32_t rank = 0; rank < ends_.size(); ++rank) {
    if (!reach(rank)) return false;
  }
  return status_.empty();
}

// Ends from left to right, those above each other from below. False if two lie at one place.
bool PlainBorder::sort(std::span<const Side> sides) {
  const std::size_t i = axis_ == 2 ? 0 : axis_ + 1;
  const std::size_t j = i == 2 ? 0 : i + 1;
  const auto order = [&](std::uint32_t a, std::uint32_t b) {
    const int first = points_.compare(a, b, i);
    return first != 0 ? first : points_.compare(a, b, j);
  };
  ends_.clear();
  for (const Side& side : sides) ends_.insert(ends_.end(), side.begin(), side.end());
  std::sort(ends_.begin(), ends_.end());
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  std::sort(ends_.begin(), ends_.end(), [&](std::uint32_t a, std::uint32_t b) { return order(a, b) < 0; });
  for (std::uint32_t rank = 0; rank < ends_.size(); ++rank) {
    if (rank > 0 && order(ends_[rank - 1], ends_[rank]) == 0) return false;
    rank_[ends_[rank]] = rank;
  }
  return true;
}

void PlainBorder::list_segments(std::span<const Side> sides, int turn) {
  begin_.assign(ends_.size() + 1, 0);
  arriving_.assign(ends_.size(), 0);
  for (const auto& [from, to] : sides) {
    ++begin_[std::min(rank_[from], rank_[to]) + 1];
    ++arriving_[std::max(rank_[from], rank_[to])];
  }
  for (std::size_t rank = 1; rank < begin_.size(); ++rank) begin_[rank] += begin_[rank - 1];
  segments_.resize(sides.size());
  std::vector<std::uint32_t> at(begin_.begin(), begin_.end() - 1);
  for (const auto& [from, to] : sides) {
    const auto [left, right] = std::minmax(rank_[from], rank_[to]);
    segments_[at[left]++] = {left, right, (rank_[from] < rank_[to]) == (turn > 0)};
  }
}

int PlainBorder::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return points_.orientation_along(ends_[a], ends_[b], ends_[c], axis_, monitor_);
}

// 1 if the end lies above the segment, -1 below, 0 on its line.
int PlainBorder::side_of(std::uint32_t rank, std::uint32_t segment) const {
  return turn(segments_[segment].left, segments_[segment].right, rank);
}

// The line comes to an end: what arrives there makes room for what leaves.
bool PlainBorder::reach(std::uint32_t rank) {
  const auto place = std::partition_point(status_.begin(), status_.end(),
                                          [&](std::uint32_t segment) { return side_of(rank, segment) > 0; });
  const auto first = static_cast<std::size_t>(place - status_.begin());
  const std::size_t last = first + arriving_[rank];
  if (last > status_.size()) return false;
  for (std::size_t k = first; k < last; ++k) {
    if (segments_[status_[k]].right != rank) return false;
  }
  if (last < status_.size() && side_of(rank, status_[last]) >= 0) return false;
  leaving_.resize(begin_[rank + 1] - begin_[rank]);
  for (std::uint32_t k = 0; k < leaving_.size(); ++k) leaving_[k] = begin_[rank] + k;
  if (!sort_leaving(leaving_)) return false;
  const std::size_t kept = std::min<std::size_t>(arriving_[rank], leaving_.size());
  std::copy_n(leaving_.begin(), kept, place);
  const auto behind = place + static_cast<std::ptrdiff_t>(kept);
  if (kept < leaving_.size()) {
    status_.insert(behind, leaving_.begin() + static_cast<std::ptrdiff_t>(kept), leaving_.end());
  } else {
    status_.erase(behind, status_.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return alternate(first, first + leaving_.size());
}

// From below; false if two lie on each other.
bool PlainBorder::sort_leaving(std::span<std::uint32_t> leaving) const {
  for (std::size_t k = 1; k < leaving.size(); ++k) {
    for (std::size_t at = k; at > 0; --at) {
      const int side = side_of(segments_[leaving[at]].right, leaving[at - 1]);
      if (side == 0) return false;
      if (side > 0) break;
      std::swap(leaving[at], leaving[at - 1]);
    }
  }
  return true;
}

// Segments that are new in the status, and their neighbours.
bool PlainBorder::alternate(std::size_t first, std::size_t last) const {
  const auto is_floor = [&](std::size_t k) { return segments_[status_[k]].is_floor; };
  if (first == 0 && !status_.empty() && !is_floor(0)) return false;
  if (last == status_.size() && !status_.empty() && is_floor(last - 1)) return false;
  for (std::size_t k = std::max<std::size_t>(first, 1); k <= last && k < status_.size(); ++k) {
    if (is_floor(k) == is_floor(k - 1)) return false;
    // Those that leave together have been told apart.
    if ((k == first || k == last) && !apart(status_[k - 1], status_[k])) return false;
  }
  return true;
}

// Of neighbours, up to the end that is reached first.
bool PlainBorder::apart(std::uint32_t below, std::uint32_t above) const {
  const Segment& a = segments_[below];
  const Segment& b = segments_[above];
  if (a.right == b.right) return true;
  return a.right < b.right ? side_of(a.right, above) < 0 : side_of(b.right, below) > 0;
}

}  // namespace nef
