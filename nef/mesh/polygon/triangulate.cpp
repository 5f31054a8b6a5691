// SPDX-License-Identifier: Apache-2.0
//
// Rings that may be no polygon lose their ears: strictly convex corners whose triangle holds no other vertex are cut off.
// Vertices are compared by index, so that a ring that meets itself is not in its own way. Polygons that are known to be
// some are swept, but for what is seen to be convex or has four corners.
#include "nef/mesh/polygon/triangulate.h"

#include <algorithm>
#include <cmath>

#include "nef/complex/facet_plane.h"

namespace nef {

ProjectionAxis projection_axis(const PlaneTable& planes, PlaneId plane) {
  const PlaneAxes axes(planes, plane);
  return {static_cast<std::size_t>(axes.dropped), axes.positive != plane.flipped() ? 1 : -1};
}

int Triangulator::turn_at(std::uint32_t node) const {
  const Node& n = nodes_[node];
  return turn(nodes_[n.prev].point, n.point, nodes_[n.next].point);
}

std::uint32_t Triangulator::append_ring(std::span<const std::uint32_t> ring) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  const auto size = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    nodes_.push_back({ring[i], first + (i + size - 1) % size, first + (i + 1) % size});
  }
  return first;
}

// Tells whether points lie in a triangle, borders included, by doubles where these are sure.
//
// The filter is that of MeshPoints::orientation_along for points in the box of the triangle: the sides of the box,
// which are no smaller than any difference of coordinates in it, stand for these differences in its bound. Where
// coordinates are integers and products of differences are below 2^52, everything is computed exactly.
class Triangulator::Ear {
 public:
  Ear(const Triangulator& triangulator, std::uint32_t node)
      : triangulator_(triangulator), points_(triangulator.points_) {
    const Node& tip = triangulator.nodes_[node];
    corner_ = {triangulator.nodes_[tip.prev].point, tip.point, triangulator.nodes_[tip.next].point};
    std::array<double, 2> size;
    std::array<double, 2> error;
    bool integers = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t axis = (triangulator.axis_ + 1 + k) % 3;
      const double margin = points_.margin(axis);
      for (std::size_t i = 0; i < 3; ++i) at_[i][k] = points_.approximate(corner_[i])[axis];
      // What surely lies outside of the ear is not asked for. Coordinates are within half of the margin, so that the
      // rounding of these bounds does no harm.
      low[k] = std::min({at_[0][k], at_[1][k], at_[2][k]}) - 2 * margin;
      high[k] = std::max({at_[0][k], at_[1][k], at_[2][k]}) + 2 * margin;
      size[k] = (high[k] - low[k]) * (1 + 0x1p-50) + 2 * margin;
      error[k] = 2 * margin + 0x1p-53 * size[k];
      integers = integers && margin == 0;
    }
    if (!points_.moderate()) {
      bound_ = HUGE_VAL;
    } else if (!integers || size[0] * size[1] >= 0x1p51) {
      bound_ = 3 * (error[0] * size[1] + size[0] * error[1]) + 0x1p-49 * size[0] * size[1] + 1e-290;
    }
  }

  // Of the box that the triangle is in.
  std::array<double, 2> low;
  std::array<double, 2> high;

  // Whether a node that is not convex and in the box is in the way.
  [[nodiscard]] bool holds(std::uint32_t node, double x, double y) const {
    const Node& other = triangulator_.nodes_[node];
    const std::uint32_t p = other.point;
    if (!other.blunt || p == corner_[0] || p == corner_[1] || p == corner_[2]) return false;
    bool sure = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& a = at_[i];
      const auto& b = at_[i == 2 ? 0 : i + 1];
      const double turn = triangulator_.sign_ * ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]));
      if (turn < -bound_) return false;
      sure = sure && (turn > bound_ || bound_ == 0);
    }
    if (sure) return true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangulator_.turn(corner_[i], corner_[i == 2 ? 0 : i + 1], p) < 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool holds(std::uint32_t node) const {
    const auto& x = points_.approximate(triangulator_.nodes_[node].point);
    const std::array<double, 2> p{x[(triangulator_.axis_ + 1) % 3], x[(triangulator_.axis_ + 2) % 3]};
    for (std::size_t k = 0; k < 2; ++k) {
      if (p[k] < low[k] || p[k] > high[k]) return false;
    }
    return holds(node, p[0], p[1]);
  }

 private:
  const Triangulator& triangulator_;
  const MeshPoints& points_;
  std::array<std::uint32_t, 3> corner_;
  std::array<std::array<double, 2>, 3> at_;
  double bound_ = 0;
};

bool Triangulator::is_ear(std::uint32_t node) const {
  const Ear ear(*this, node);
  std::array<std::pair<Row::const_iterator, Row::const_iterator>, 2> range;
  for (std::size_t k = 0; k < 2; ++k) {
    range[k].first = std::lower_bound(rows_[k].begin(), rows_[k].end(), ear.low[k],
                                      [](const Place& place, double x) { return place.at < x; });
    range[k].second = std::upper_bound(range[k].first, rows_[k].cend(), ear.high[k],
                                       [](double x, const Place& place) { return x < place.at; });
  }
  const std::size_t k = range[0].second - range[0].first <= range[1].second - range[1].first ? 0 : 1;
  for (auto place = range[k].first; place != range[k].second; ++place) {
    if (place->other < ear.low[1 - k] || place->other > ear.high[1 - k]) continue;
    const double x = k == 0 ? place->at : place->other;
    const double y = k == 0 ? place->other : place->at;
    if (ear.holds(place->node, x, y)) return false;
  }
  for (std::size_t i = sorted_; i < blunt_.size(); ++i) {
    if (ear.holds(blunt_[i])) return false;
  }
  return true;
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
      const auto& x = points_.approximate(nodes_[node].point);
      row.push_back({x[(axis_ + 1 + k) % 3], x[(axis_ + 2 - k) % 3], node});
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

void Triangulator::collect_blunt(std::uint32_t start, std::size_t& count) {
  blunt_.clear();
  count = 0;
  std::uint32_t node = start;
  do {
    nodes_[node].blunt = turn_at(node) <= 0;
    if (nodes_[node].blunt) blunt_.push_back(node);
    ++count;
    node = nodes_[node].next;
  } while (node != start);
  sort_blunt();
}

bool Triangulator::clip(std::uint32_t start, std::vector<Triangle>& out) {
  std::size_t count = 0;
  collect_blunt(start, count);
  std::uint32_t node = start;
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
    out.push_back({nodes_[before].point, nodes_[node].point, nodes_[after].point});
    nodes_[before].next = after;
    nodes_[after].prev = before;
    --count;
    // A cut can flatten a corner that was convex (it ends on a bridge), so both directions are possible.
    for (const std::uint32_t neighbour : {before, after}) set_blunt(neighbour, turn_at(neighbour) <= 0);
    // Going on with the corner after the next gives better triangles than peeling a fan.
    node = nodes_[after].next;
  }
  if (turn_at(node) <= 0) return false;
  out.push_back({nodes_[nodes_[node].prev].point, nodes_[node].point, nodes_[nodes_[node].next].point});
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
    if (projected_.turn(i == 0 ? n - 1 : i - 1, i, i + 1 == n ? 0 : i + 1) <= 0) return false;
  }
  return goes_around_once();
}

// Two triangles on both sides of a diagonal are the polygon if both turn left.
bool Triangulator::cut_four(std::vector<Triangle>& out) const {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out.push_back({projected_.point(a), projected_.point(b), projected_.point(c)});
  };
  if (projected_.turn(3, 0, 1) > 0 && projected_.turn(1, 2, 3) > 0) {
    add(3, 0, 1);
    add(1, 2, 3);
    return true;
  }
  if (projected_.turn(0, 1, 2) <= 0 || projected_.turn(2, 3, 0) <= 0) return false;
  add(0, 1, 2);
  add(2, 3, 0);
  return true;
}

// Tells whether a corner is in the way of an ear, borders included.
bool Triangulator::blocks(std::uint32_t corner, const std::array<std::uint32_t, 3>& ear) const {
  const std::uint32_t p = projected_.point(corner);
  if (p == projected_.point(ear[0]) || p == projected_.point(ear[1]) || p == projected_.point(ear[2])) return false;
  return projected_.turn(ear[2], ear[0], corner) >= 0 && projected_.turn(ear[0], ear[1], corner) >= 0 &&
         projected_.turn(ear[1], ear[2], corner) >= 0;
}

// Ears of a ring of at most kSmall corners, as clip cuts them off; false if there are none left.
bool Triangulator::clip_small(std::span<const std::uint32_t> corners, std::vector<Triangle>& out) {
  const auto n = static_cast<std::uint32_t>(projected_.size());
  std::array<std::uint32_t, kSmall> prev;
  std::array<std::uint32_t, kSmall> next;
  std::array<std::uint32_t, kSmall> blunt;
  std::array<bool, kSmall> is_blunt;
  std::uint32_t blunt_count = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    prev[i] = i == 0 ? n - 1 : i - 1;
    next[i] = i + 1 == n ? 0 : i + 1;
    is_blunt[i] = projected_.turn(prev[i], i, next[i]) <= 0;
    if (is_blunt[i]) blunt[blunt_count++] = i;
  }
  if (blunt_count == 0 && goes_around_once()) {
    cut_convex(corners, out);
    return true;
  }
  std::uint32_t at = 0;
  std::uint32_t failures = 0;
  for (std::uint32_t count = n; count > 3;) {
    const std::array<std::uint32_t, 3> ear{prev[at], at, next[at]};
    const auto is_free = [&] {
      return std::none_of(blunt.begin(), blunt.begin() + blunt_count, [&](std::uint32_t b) { return blocks(b, ear); });
    };
    if (is_blunt[at] || !is_free()) {
      at = next[at];
      if (++failures > count) return false;
      continue;
    }
    failures = 0;
    out.push_back({projected_.point(ear[0]), projected_.point(at), projected_.point(ear[2])});
    next[ear[0]] = ear[2];
    prev[ear[2]] = ear[0];
    --count;
    for (const std::uint32_t i : {ear[0], ear[2]}) {
      const bool was_blunt = is_blunt[i];
      is_blunt[i] = projected_.turn(prev[i], i, next[i]) <= 0;
      if (is_blunt[i] == was_blunt) continue;
      if (is_blunt[i]) {
        blunt[blunt_count++] = i;
      } else {
        std::uint32_t* const end = blunt.data() + blunt_count--;
        *std::find(blunt.data(), end, i) = end[-1];
      }
    }
    at = next[ear[2]];
  }
  if (projected_.turn(prev[at], at, next[at]) <= 0) return false;
  out.push_back({projected_.point(prev[at]), projected_.point(at), projected_.point(next[at])});
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
  axis_ = axis;
  sign_ = sign;
  nodes_.clear();
  if (ring.size() < 3) return false;
  const std::uint32_t start = append_ring(ring);
  const std::size_t old = out.size();
  if (clip(start, out)) return true;
  out.resize(old);
  return false;
}

// Cuts off every second corner, round after round, as clip does where nothing is in the way.
void Triangulator::cut_convex(std::span<const std::uint32_t> ring, std::vector<Triangle>& out) {
  nodes_.clear();
  std::uint32_t node = append_ring(ring);
  for (std::size_t count = ring.size(); count > 2; --count) {
    const std::uint32_t before = nodes_[node].prev;
    const std::uint32_t after = nodes_[node].next;
    out.push_back({nodes_[before].point, nodes_[node].point, nodes_[after].point});
    nodes_[before].next = after;
    nodes_[after].prev = before;
    node = nodes_[after].next;
  }
}

}  // namespace nef
