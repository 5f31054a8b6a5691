// SPDX-License-Identifier: Apache-2.0
//
// Holes are joined to the outer ring one after another, the one that reaches farthest (lexicographically) first, by a
// segment from its farthest vertex to a vertex that lies farther still. Holes that are not joined yet can not block
// such a segment, so only the ring that has grown so far is looked at, and some vertex of it is always visible.
// Then strictly convex corners whose triangle holds no other vertex are cut off. Vertices are compared by
// index, so that the two sides of a bridge, and a ring that meets itself, are not in each other's way.
#include "nef/mesh/polygon/triangulate.h"

#include <algorithm>
#include <cmath>

#include "nef/complex/facet_plane.h"
#include "nef/mesh/polygon/simple_ring.h"

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

// True if the direction from a node to a point runs into the polygon.
bool Triangulator::in_cone(std::uint32_t node, std::uint32_t point) const {
  const std::uint32_t before = nodes_[nodes_[node].prev].point;
  const std::uint32_t at = nodes_[node].point;
  const std::uint32_t after = nodes_[nodes_[node].next].point;
  const int corner = turn(before, at, after);
  const bool left_of_next = turn(at, after, point) > 0;
  const bool left_of_prev = turn(before, at, point) > 0;
  if (corner > 0) return left_of_next && left_of_prev;
  if (corner < 0) return left_of_next || left_of_prev;
  // The tip of a dangling edge is open all around; a straight corner on one side.
  const bool tip = (points_.compare(before, at) < 0) == (points_.compare(after, at) < 0);
  return tip || left_of_next;
}

bool Triangulator::sees(std::uint32_t hole, std::uint32_t target, std::uint32_t outer) const {
  const std::uint32_t p = nodes_[hole].point;
  const std::uint32_t q = nodes_[target].point;
  if (!in_cone(target, p)) return false;
  Box box;
  points_.extend(box, p);
  points_.extend(box, q);
  std::uint32_t node = outer;
  do {
    const std::uint32_t a = nodes_[node].point;
    const std::uint32_t b = nodes_[nodes_[node].next].point;
    Box edge;
    points_.extend(edge, a);
    points_.extend(edge, b);
    if (box.overlaps(edge)) {
      const bool touches = a == q || b == q;
      if (!touches && segments_meet(points_, p, q, a, b, axis_)) return false;
      // An edge at the target may only meet the segment there: not if it runs back along it.
      if (touches && a != b) {
        const std::uint32_t other = a == q ? b : a;
        if (turn(p, q, other) == 0 && (points_.compare(other, q) < 0) == (points_.compare(p, q) < 0)) return false;
      }
    }
    node = nodes_[node].next;
  } while (node != outer);
  return true;
}

// Makes one ring of two by a bridge, walked once in each direction.
void Triangulator::join(std::uint32_t hole, std::uint32_t target) {
  if (nodes_[hole].point == nodes_[target].point) {
    const std::uint32_t hole_next = nodes_[hole].next;
    const std::uint32_t target_next = nodes_[target].next;
    nodes_[hole].next = target_next;
    nodes_[target_next].prev = hole;
    nodes_[target].next = hole_next;
    nodes_[hole_next].prev = target;
    return;
  }
  const auto hole_copy = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t target_copy = hole_copy + 1;
  const Node old_hole = nodes_[hole];
  const Node old_target = nodes_[target];
  // target -> hole ... hole_copy -> target_copy -> what followed target.
  nodes_.push_back({old_hole.point, old_hole.prev, target_copy});
  nodes_.push_back({old_target.point, hole_copy, old_target.next});
  nodes_[old_hole.prev].next = hole_copy;
  nodes_[old_target.next].prev = target_copy;
  nodes_[target].next = hole;
  nodes_[hole].prev = target;
}

bool Triangulator::bridge(std::uint32_t hole, std::uint32_t outer) {
  const std::uint32_t p = nodes_[hole].point;
  const auto& from = points_.approximate(p);
  std::vector<std::pair<double, std::uint32_t>> candidates;
  std::uint32_t node = outer;
  do {
    const std::uint32_t q = nodes_[node].point;
    if (q == p && in_cone(node, nodes_[nodes_[hole].next].point)) {
      join(hole, node);
      return true;
    }
    if (q != p && points_.compare(q, p) > 0) {
      const auto& to = points_.approximate(q);
      const double distance = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
      candidates.emplace_back(distance == distance ? distance : HUGE_VAL, node);
    }
    node = nodes_[node].next;
  } while (node != outer);
  // The nearest vertex is nearly always visible, so a heap beats sorting all.
  const auto farther = [](const auto& x, const auto& y) { return y < x; };
  std::make_heap(candidates.begin(), candidates.end(), farther);
  while (!candidates.empty()) {
    std::pop_heap(candidates.begin(), candidates.end(), farther);
    const std::uint32_t target = candidates.back().second;
    candidates.pop_back();
    if (!sees(hole, target, outer)) continue;
    // A hole that meets itself there has more than one corner at that vertex.
    std::uint32_t corner = hole;
    do {
      if (nodes_[corner].point == p && in_cone(corner, nodes_[target].point)) {
        join(corner, target);
        return true;
      }
      corner = nodes_[corner].next;
    } while (corner != hole);
  }
  return false;
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

void Triangulator::sort_blunt() {
  std::erase_if(blunt_, [this](std::uint32_t node) { return !nodes_[node].blunt; });
  for (std::size_t k = 0; k < 2; ++k) {
    Row& row = rows_[k];
    row.clear();
    for (const std::uint32_t node : blunt_) {
      const auto& x = points_.approximate(nodes_[node].point);
      row.push_back({x[(axis_ + 1 + k) % 3], x[(axis_ + 2 - k) % 3], node});
    }
    std::sort(row.begin(), row.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
  }
  sorted_ = blunt_.size();
  stale_ = 0;
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
  constexpr std::size_t kFew = 16;
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

bool Triangulator::triangulate(std::span<const std::vector<std::uint32_t>> rings, std::size_t axis, int sign,
                               std::vector<Triangle>& out) {
  axis_ = axis;
  sign_ = sign;
  nodes_.clear();
  if (rings.empty() || rings[0].size() < 3) return false;
  const std::uint32_t outer = append_ring(rings[0]);
  std::vector<std::uint32_t> holes;  // the farthest node of each
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (rings[i].empty()) return false;
    const std::uint32_t first = append_ring(rings[i]);
    std::uint32_t best = first;
    for (std::uint32_t node = first; node < nodes_.size(); ++node) {
      if (points_.compare(nodes_[node].point, nodes_[best].point) > 0) best = node;
    }
    holes.push_back(best);
  }
  std::sort(holes.begin(), holes.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int order = points_.compare(nodes_[a].point, nodes_[b].point);
    return order != 0 ? order > 0 : a < b;
  });
  for (const std::uint32_t hole : holes) {
    if (!bridge(hole, outer)) return false;
  }
  const std::size_t old = out.size();
  if (clip(outer, out)) return true;
  out.resize(old);
  return false;
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
