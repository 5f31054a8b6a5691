// SPDX-License-Identifier: Apache-2.0
//
// Rings that may be no polygon lose their ears: strictly convex corners whose triangle holds no other vertex are cut
// off. Vertices are compared by index, so that a ring that meets itself is not in its own way. Polygons that are known
// to be some are swept, but for what is seen to be convex or has four corners.
#include "nef/mesh/polygon/triangulate.h"

#include <algorithm>
#include <cmath>

#include "nef/complex/facet_plane.h"

namespace nef {

ProjectionAxis projection_axis(const PlaneTable& planes, PlaneId plane) {
  const PlaneAxes axes(planes, plane);
  return {static_cast<std::size_t>(axes.dropped), axes.positive != plane.flipped() ? 1 : -1};
}

void Triangulator::link_corners() {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  nodes_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) nodes_[i] = {i == 0 ? n - 1 : i - 1, i + 1 == n ? 0 : i + 1, false};
}

bool Triangulator::is_blunt(std::uint32_t node) const {
  return !projected_.turns_left(nodes_[node].prev, node, nodes_[node].next);
}

bool Triangulator::is_ear(std::uint32_t node) const {
  const ProjectedCorners::Triangle ear(projected_, nodes_[node].prev, node, nodes_[node].next);
  const auto blocks = [&](std::uint32_t other) { return nodes_[other].blunt && ear.holds(other); };
  const std::array<double, 2> low = ear.low();
  const std::array<double, 2> high = ear.high();
  std::array<std::pair<Row::const_iterator, Row::const_iterator>, 2> range;
  for (std::size_t k = 0; k < 2 && sorted_ > 0; ++k) {
    range[k].first = std::lower_bound(rows_[k].begin(), rows_[k].end(), low[k],
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

// Few are all compared with each ear, which is sooner done than to search for those beside it.
void Triangulator::sort_blunt() {
  std::erase_if(blunt_, [this](std::uint32_t node) { return !nodes_[node].blunt; });
  stale_ = 0;
  sorted_ = 0;
  for (Row& row : rows_) row.clear();
  if (blunt_.size() <= kFew) return;
  for (std::size_t k = 0; k < 2; ++k) {
    Row& row = rows_[k];
    for (const std::uint32_t node : blunt_) {
      const ProjectedCorners::Corner& at = projected_[node];
      row.push_back({k == 0 ? at.x : at.y, k == 0 ? at.y : at.x, node});
    }
    std::sort(row.begin(), row.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
  }
  sorted_ = blunt_.size();
}

// Sorts anew after as many changes that nothing is looked at in vain for long.
void Triangulator::set_blunt(std::uint32_t node, bool blunt) {
  if (nodes_[node].blunt == blunt) return;
  nodes_[node].blunt = blunt;
  if (blunt) {
    blunt_.push_back(node);
  } else {
    ++stale_;
  }
  if (stale_ > kFew + sorted_ / 2 || blunt_.size() - sorted_ > kFew + sorted_ / 8) sort_blunt();
}

void Triangulator::collect_blunt() {
  blunt_.clear();
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    nodes_[node].blunt = is_blunt(node);
    if (nodes_[node].blunt) blunt_.push_back(node);
  }
  sort_blunt();
}

bool Triangulator::clip(std::vector<Triangle>& out) {
  link_corners();
  collect_blunt();
  std::size_t count = nodes_.size();
  std::uint32_t node = 0;
  std::size_t failures = 0;
  while (count > 3) {
    if (nodes_[node].blunt || !is_ear(node)) {
      node = nodes_[node].next;
      if (++failures > count) return false;
      continue;
    }
    failures = 0;
    const std::uint32_t before = nodes_[node].prev;
    const std::uint32_t after = nodes_[node].next;
    push(before, node, after, out);
    nodes_[before].next = after;
    nodes_[after].prev = before;
    --count;
    // A cut can flatten a corner that was convex (it ends on another vertex), so both directions are possible.
    for (const std::uint32_t neighbour : {before, after}) set_blunt(neighbour, is_blunt(neighbour));
    // Going on with the corner after the next gives better triangles than peeling a fan.
    node = nodes_[after].next;
  }
  if (is_blunt(node)) return false;
  push(nodes_[node].prev, node, nodes_[node].next, out);
  return true;
}

// Of a ring whose corners all turn left by less than half a turn: it goes around once if it rises once and falls once.
bool Triangulator::goes_around_once() const {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  std::uint32_t peaks = 0;
  bool rose = projected_.before(projected_[n - 1], projected_[0]);
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool rises = projected_.before(projected_[i], projected_[i + 1 == n ? 0 : i + 1]);
    peaks += rose && !rises ? 1 : 0;
    rose = rises;
  }
  return peaks == 1;
}

bool Triangulator::is_convex() const {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!projected_.turns_left(i == 0 ? n - 1 : i - 1, i, i + 1 == n ? 0 : i + 1)) return false;
  }
  return goes_around_once();
}

// Two triangles on both sides of a diagonal are the polygon if both turn left.
bool Triangulator::cut_four(std::vector<Triangle>& out) const {
  if (projected_.turns_left(3, 0, 1) && projected_.turns_left(1, 2, 3)) {
    push(3, 0, 1, out);
    push(1, 2, 3, out);
    return true;
  }
  if (!projected_.turns_left(0, 1, 2) || !projected_.turns_left(2, 3, 0)) return false;
  push(0, 1, 2, out);
  push(2, 3, 0, out);
  return true;
}

// Ears of a ring of at most kSmall corners, as clip cuts them off; false if there are none left.
bool Triangulator::clip_small(std::span<const std::uint32_t> corners, std::vector<Triangle>& out) {
  link_corners();
  std::array<std::uint32_t, kSmall> blunt;
  std::size_t blunt_count = 0;
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    nodes_[i].blunt = is_blunt(i);
    if (nodes_[i].blunt) blunt[blunt_count++] = i;
  }
  if (blunt_count == 0 && goes_around_once()) {
    cut_convex(corners, out);
    return true;
  }
  const auto is_free = [&](std::uint32_t i) {
    const ProjectedCorners::Triangle ear(projected_, nodes_[i].prev, i, nodes_[i].next);
    for (std::size_t k = 0; k < blunt_count; ++k) {
      if (ear.holds(blunt[k])) return false;
    }
    return true;
  };
  std::uint32_t at = 0;
  std::uint32_t failures = 0;
  for (std::uint32_t count = n; count > 3;) {
    if (nodes_[at].blunt || !is_free(at)) {
      at = nodes_[at].next;
      if (++failures > count) return false;
      continue;
    }
    failures = 0;
    const std::uint32_t before = nodes_[at].prev;
    const std::uint32_t after = nodes_[at].next;
    push(before, at, after, out);
    nodes_[before].next = after;
    nodes_[after].prev = before;
    --count;
    for (const std::uint32_t i : {before, after}) {
      const bool was_blunt = nodes_[i].blunt;
      nodes_[i].blunt = is_blunt(i);
      if (nodes_[i].blunt == was_blunt) continue;
      if (was_blunt) {
        *std::find(blunt.begin(), blunt.begin() + blunt_count, i) = blunt[blunt_count - 1];
        --blunt_count;
      } else {
        blunt[blunt_count++] = i;
      }
    }
    at = nodes_[after].next;
  }
  if (is_blunt(at)) return false;
  push(nodes_[at].prev, at, nodes_[at].next, out);
  return true;
}

bool Triangulator::triangulate(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> ring_end,
                               std::size_t axis, int sign, std::vector<Triangle>& out) {
  if (ring_end.empty() || ring_end[0] < 3) return false;
  projected_.assign(corners, axis, sign);
  if (ring_end.size() == 1 && corners.size() == 4) return cut_four(out);
  const std::size_t old = out.size();
  if (ring_end.size() == 1 && corners.size() <= kSmall) {
    if (clip_small(corners, out)) return true;
    out.resize(old);
  } else if (ring_end.size() == 1 && is_convex()) {
    cut_convex(corners, out);
    return true;
  }
  if (sweep_.triangulate(projected_, ring_end, out)) return true;
  out.resize(old);
  return false;
}

bool Triangulator::triangulate(std::span<const std::vector<std::uint32_t>> rings, std::size_t axis, int sign,
                               std::vector<Triangle>& out) {
  corners_.clear();
  ring_end_.clear();
  for (const std::vector<std::uint32_t>& ring : rings) {
    if (ring.empty()) return false;
    corners_.insert(corners_.end(), ring.begin(), ring.end());
    ring_end_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
  return triangulate(corners_, ring_end_, axis, sign, out);
}

bool Triangulator::triangulate(std::span<const std::uint32_t> ring, std::size_t axis, int sign,
                               std::vector<Triangle>& out) {
  if (ring.size() < 3) return false;
  projected_.assign(ring, axis, sign);
  const std::size_t old = out.size();
  if (clip(out)) return true;
  out.resize(old);
  return false;
}

// Cuts off every second corner, round after round, as clip does where nothing is in the way.
void Triangulator::cut_convex(std::span<const std::uint32_t> ring, std::vector<Triangle>& out) {
  // A queue, whose first corner is the one before that which is cut off.
  queue_.assign({ring.back()});
  queue_.insert(queue_.end(), ring.begin(), ring.end() - 1);
  queue_.resize(2 * ring.size());
  std::size_t first = 0;
  for (std::size_t last = ring.size(); last < 2 * ring.size() - 2; ++last) {
    out.push_back({queue_[first], queue_[first + 1], queue_[first + 2]});
    queue_[last] = queue_[first];
    first += 2;
  }
}

}  // namespace nef
