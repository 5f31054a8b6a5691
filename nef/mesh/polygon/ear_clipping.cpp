// SPDX-License-Identifier: Apache-2.0
//
// The usual loop over a linked ring: cut the corner if it is convex and no blunt corner lies in its triangle, and go on
// with the corner after the next. Small rings are kept in arrays of bytes and a bit mask of blunt corners. Large rings
// keep their blunt corners sorted along both axes of the projection, so that an ear is compared only with those beside
// it on the axis with fewer; the rows are sorted again after enough changes. [Meisters 1975]
#include "nef/mesh/polygon/ear_clipping.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace nef {
namespace {

template <typename Ring>
bool cut_ears(Ring& ring, const ProjectedCorners& corners, std::vector<EarClipper::Triangle>& out) {
  out.resize(out.size() + corners.size() - 2);
  EarClipper::Triangle* to = &out.back() - (corners.size() - 3);
  const auto push = [&](std::uint32_t corner) {
    *to++ = {corners.point(ring.prev(corner)), corners.point(corner), corners.point(ring.next(corner))};
  };
  std::uint32_t at = 0;
  std::size_t failures = 0;
  for (std::size_t count = corners.size(); count > 3;) {
    if (ring.is_blunt(at) || !ring.is_ear(at)) {
      at = ring.next(at);
      if (++failures > count) return false;
      continue;
    }
    failures = 0;
    push(at);
    const std::uint32_t after = ring.next(at);
    ring.cut(at);
    --count;
    // Going on with the corner after the next gives better triangles than peeling a fan.
    at = ring.next(after);
  }
  if (ring.is_blunt(at)) return false;
  push(at);
  return true;
}

}  // namespace

// Without tables: a bit stands for each corner.
class EarClipper::SmallRing {
 public:
  SmallRing(const ProjectedCorners& corners, std::uint32_t blunt) : corners_(corners), blunt_(blunt) {
    const auto last = static_cast<std::uint8_t>(corners.size() - 1);
    for (std::uint8_t i = 0; i < last; ++i) {
      prev_[i + 1U] = i;
      next_[i] = static_cast<std::uint8_t>(i + 1);
    }
    prev_[0] = last;
    next_[last] = 0;
  }

  [[nodiscard]] std::uint32_t prev(std::uint32_t i) const { return prev_[i]; }
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return next_[i]; }
  [[nodiscard]] bool is_blunt(std::uint32_t i) const { return (blunt_ >> i & 1U) != 0; }

  [[nodiscard]] bool is_ear(std::uint32_t i) const {
    std::uint32_t others = blunt_ & ~(1U << prev_[i] | 1U << next_[i]);
    if (others == 0) return true;
    const ProjectedCorners::Triangle ear(corners_, prev_[i], i, next_[i]);
    for (; others != 0; others &= others - 1) {
      if (ear.holds(static_cast<std::uint32_t>(std::countr_zero(others)))) return false;
    }
    return true;
  }

  void cut(std::uint32_t i) {
    const std::uint8_t before = prev_[i];
    const std::uint8_t after = next_[i];
    next_[before] = after;
    prev_[after] = before;
    find_blunt(before);
    find_blunt(after);
  }

 private:
  static_assert(kSmall <= 32);

  void find_blunt(std::uint32_t i) {
    const std::uint32_t bit = 1U << i;
    blunt_ = corners_.turns_left(prev_[i], i, next_[i]) ? blunt_ & ~bit : blunt_ | bit;
  }

  const ProjectedCorners& corners_;
  std::array<std::uint8_t, kSmall> prev_;
  std::array<std::uint8_t, kSmall> next_;
  std::uint32_t blunt_;
};

// Ears are compared with what lies beside them, which is looked up in rows along both axes.
class EarClipper::LargeRing {
 public:
  LargeRing(EarClipper& memory, const ProjectedCorners& corners)
      : corners_(corners), nodes_(memory.nodes_), blunt_(memory.blunt_), rows_(memory.rows_) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    nodes_.resize(n);
    blunt_.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
      nodes_[i] = {i == 0 ? n - 1 : i - 1, i + 1 == n ? 0 : i + 1, false};
      nodes_[i].blunt = !turns_left(i);
      if (nodes_[i].blunt) blunt_.push_back(i);
    }
    sort_blunt();
  }

  [[nodiscard]] std::uint32_t prev(std::uint32_t i) const { return nodes_[i].prev; }
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return nodes_[i].next; }
  [[nodiscard]] bool is_blunt(std::uint32_t i) const { return nodes_[i].blunt; }

  [[nodiscard]] bool is_ear(std::uint32_t i) const {
    const ProjectedCorners::Triangle ear(corners_, nodes_[i].prev, i, nodes_[i].next);
    const auto blocks = [&](std::uint32_t other) { return nodes_[other].blunt && ear.holds(other); };
    const std::array<double, 2> low = ear.low();
    const std::array<double, 2> high = ear.high();
    std::array<std::pair<Row::const_iterator, Row::const_iterator>, 2> range;
    for (std::size_t k = 0; k < 2 && sorted_ > 0; ++k) {
      range[k].first = std::lower_bound(rows_[k].cbegin(), rows_[k].cend(), low[k],
                                        [](const Place& place, double x) { return place.at < x; });
      range[k].second = std::upper_bound(range[k].first, rows_[k].cend(), high[k],
                                         [](double x, const Place& place) { return x < place.at; });
    }
    const std::size_t k = range[0].second - range[0].first <= range[1].second - range[1].first ? 0 : 1;
    for (auto place = range[k].first; place != range[k].second; ++place) {
      // What can not be compared, beyond the range of doubles, is asked for.
      if (place->other < low[1 - k] || place->other > high[1 - k]) continue;
      if (blocks(place->node)) return false;
    }
    return std::none_of(blunt_.begin() + static_cast<std::ptrdiff_t>(sorted_), blunt_.end(), blocks);
  }

  void cut(std::uint32_t i) {
    const auto [before, after, blunt] = nodes_[i];
    nodes_[before].next = after;
    nodes_[after].prev = before;
    // A cut can flatten a corner that was convex (it ends on another vertex), so both directions are possible.
    for (const std::uint32_t neighbour : {before, after}) set_blunt(neighbour, !turns_left(neighbour));
  }

 private:
  static constexpr std::size_t kFew = 16;  // corners that need no order

  [[nodiscard]] bool turns_left(std::uint32_t i) const {
    return corners_.turns_left(nodes_[i].prev, i, nodes_[i].next);
  }

  // Few are all compared with each ear, which is sooner done than to search for those beside it.
  void sort_blunt() {
    std::erase_if(blunt_, [this](std::uint32_t node) { return !nodes_[node].blunt; });
    stale_ = 0;
    sorted_ = 0;
    for (Row& row : rows_) row.clear();
    if (blunt_.size() <= kFew) return;
    for (std::size_t k = 0; k < 2; ++k) {
      Row& row = rows_[k];
      for (const std::uint32_t node : blunt_) {
        const ProjectedCorners::Corner& at = corners_[node];
        row.push_back({k == 0 ? at.x : at.y, k == 0 ? at.y : at.x, node});
      }
      std::sort(row.begin(), row.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
    }
    sorted_ = blunt_.size();
  }

  // Sorts anew after as many changes that nothing is looked at in vain for long.
  void set_blunt(std::uint32_t node, bool blunt) {
    if (nodes_[node].blunt == blunt) return;
    nodes_[node].blunt = blunt;
    if (blunt) {
      blunt_.push_back(node);
    } else {
      ++stale_;
    }
    if (stale_ > kFew + sorted_ / 2 || blunt_.size() - sorted_ > kFew + sorted_ / 8) sort_blunt();
  }

  const ProjectedCorners& corners_;
  std::vector<Node>& nodes_;
  std::vector<std::uint32_t>& blunt_;
  std::array<Row, 2>& rows_;
  std::size_t sorted_ = 0;  // how many of blunt_ are in the rows
  std::size_t stale_ = 0;   // and how many of those have become convex
};

bool EarClipper::triangulate(const ProjectedCorners& corners, std::vector<Triangle>& out) {
  if (corners.size() <= kSmall) return triangulate_small(corners, corners.blunt_corners(), out);
  LargeRing ring(*this, corners);
  return cut_ears(ring, corners, out);
}

bool EarClipper::triangulate_small(const ProjectedCorners& corners, std::uint32_t blunt, std::vector<Triangle>& out) {
  SmallRing ring(corners, blunt);
  return cut_ears(ring, corners, out);
}

}  // namespace nef
