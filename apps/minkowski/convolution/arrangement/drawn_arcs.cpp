// SPDX-License-Identifier: Apache-2.0
//
// Nodes are the ends of arcs, equal ones merged, and crossings. Each pair of arcs is asked where it meets: on different
// circles, in the direction in which both planes do or against it; on one circle, at ends. Then arcs are cut at the
// nodes inside them, and pieces that coincide become one. There is nothing to locate: regions have no marks.
#include "apps/minkowski/convolution/arrangement/drawn_arcs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "nef/geometry/direction_error.h"
#include "nef/geometry/vectors.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
namespace {

// Among more nodes, equal ones are found by a grid.
constexpr std::size_t kFewNodes = 48;

// The unit vectors of the doubles of equal directions are within 2 sqrt(3) kMostDirectionError of each other in each
// coordinate, as nef/sphere_map/overlay.cpp says of one, and a few roundings.
constexpr double kSlack = 0x1p-25;
static_assert(2 * 1.7321 * kMostDirectionError + 0x1p-48 < kSlack);
constexpr double kCells = 0x1p12;  // per unit of length

Double3 unit(const Direction& d) {
  const Double3& v = d.approximate;
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// Different cells may have the same key, which costs an exact question.
std::uint64_t key_of_cell(const Double3& place) {
  std::uint64_t key = 0;
  for (const double x : place) {
    key = (key ^ (key >> 29U)) * 0x9e3779b97f4a7c15ULL + std::bit_cast<std::uint64_t>(std::floor(x * kCells) + 0.0);
  }
  return key;
}

}  // namespace

void DrawnArcs::begin(const PlaneTable& planes, const Monitor& monitor) {
  planes_ = &planes;
  monitor_ = monitor;
  drawing_.clear();
  keys_.clear();
  cell_.clear();
  input_.clear();
  hits_.clear();
}

std::uint32_t DrawnArcs::node_of(const End& end) {
  std::uint32_t node = kNone;
  if (end.key != 0) {
    const auto same = std::find(keys_.begin(), keys_.end(), end.key);
    if (same != keys_.end()) node = static_cast<std::uint32_t>(same - keys_.begin());
  }
  if (node == kNone) node = node_at(end.direction);
  if (keys_[node] == 0) keys_[node] = end.key;
  drawing_.nodes[node].mark |= end.mark;
  return node;
}

std::uint32_t DrawnArcs::node_at(const Direction& direction) {
  std::vector<Arrangement::Node>& nodes = drawing_.nodes;
  const auto is_at = [&](std::uint32_t i) { return same_direction(nodes[i].direction, direction, monitor_); };
  const auto count = static_cast<std::uint32_t>(nodes.size());
  if (count <= kFewNodes) {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (is_at(i)) return i;
    }
  } else {
    if (cell_.empty()) {
      for (std::uint32_t i = 0; i < count; ++i) file(i);
    }
    // Both ends of what a coordinate may be are in one cell, or in neighbours.
    const Double3 u = unit(direction);
    for (unsigned corner = 0; corner < 8; ++corner) {
      Double3 place;
      bool is_new = true;
      for (unsigned i = 0; i < 3; ++i) {
        const bool high = (corner >> i & 1U) != 0;
        place[i] = u[i] + (high ? kSlack : -kSlack);
        is_new = is_new && !(high && std::floor(place[i] * kCells) == std::floor((u[i] - kSlack) * kCells));
      }
      if (!is_new) continue;
      const auto [first, last] = cell_.equal_range(key_of_cell(place));
      for (auto at = first; at != last; ++at) {
        if (is_at(at->second)) return at->second;
      }
    }
  }
  Arrangement::Node node;
  node.direction = direction;
  nodes.push_back(std::move(node));
  keys_.push_back(0);
  if (!cell_.empty()) file(count);
  return count;
}

void DrawnArcs::file(std::uint32_t node) { cell_.emplace(key_of_cell(unit(drawing_.nodes[node].direction)), node); }

void DrawnArcs::add_arc(PlaneId plane, const End& source, const End& target, LabelId mark) {
  const std::uint32_t from = node_of(source);
  input_.push_back({plane, from, node_of(target), mark});
}

void DrawnArcs::add_circle(PlaneId plane, LabelId mark) { input_.push_back({plane, kNone, kNone, mark}); }

void DrawnArcs::hit(std::uint32_t arc, std::uint32_t node) {
  hits_.emplace_back(arc, node);
  drawing_.nodes[node].mark |= input_[arc].mark;
}

// Where an arc's circle meets that of n_other at n_arc x n_other, it goes from the positive to the negative side. An
// arc of at most half a circle with both ends on one side does not meet the other circle; one with both ends on it has
// them at both meetings.
DrawnArcs::Meetings DrawnArcs::meetings(const Input& arc, const Input& other, const Direction& crossing) const {
  if (arc.is_circle()) return {Meeting{true, kNone}, Meeting{true, kNone}};
  Meetings result;
  const auto side = [&](std::uint32_t node) {
    if (node == other.source || node == other.target) return 0;
    return side_of_circle(*planes_, other.plane, drawing_.nodes[node].direction, monitor_);
  };
  const int from = side(arc.source);
  const int to = side(arc.target);
  for (const auto& [of_end, node] : {std::pair(from, arc.source), std::pair(to, arc.target)}) {
    if (of_end != 0) continue;
    // At the meeting or its antipode, which are far apart: the filter always answers.
    result[sign_of_dot(drawing_.nodes[node].direction, crossing, monitor_) > 0 ? 0 : 1] = {true, node};
  }
  if (from * to < 0) result[from > 0 ? 0 : 1].meets = true;
  return result;
}

void DrawnArcs::cross(std::uint32_t i, std::uint32_t j) {
  const Input a = input_[i];
  const Input b = input_[j];
  if (a.plane.row() == b.plane.row()) return cross_on_circle(i, j);
  Direction crossing = Direction::cross(*planes_, a.plane, b.plane);
  const Meetings of_a = meetings(a, b, crossing);
  if (!of_a[0].meets && !of_a[1].meets) return;
  Meetings of_b = meetings(b, a, crossing.negated());
  std::swap(of_b[0], of_b[1]);
  for (const std::size_t k : {0U, 1U}) {
    if (!of_a[k].meets || !of_b[k].meets) continue;
    std::uint32_t node = of_a[k].node != kNone ? of_a[k].node : of_b[k].node;
    if (node == kNone) node = node_at(k == 0 ? crossing : crossing.negated());
    if (of_a[k].node == kNone) hit(i, node);
    if (of_b[k].node == kNone) hit(j, node);
  }
}

void DrawnArcs::cross_on_circle(std::uint32_t i, std::uint32_t j) {
  for (const auto& [x, y] : {std::pair(i, j), std::pair(j, i)}) {
    const Input arc = input_[x];
    const Input other = input_[y];
    if (other.is_circle()) continue;
    for (const std::uint32_t node : {other.source, other.target}) {
      if (node == arc.source || node == arc.target) continue;
      const std::vector<Arrangement::Node>& n = drawing_.nodes;
      if (arc.is_circle() || strictly_between_on_circle(*planes_, arc.plane, n[arc.source].direction, n[node].direction,
                                                        n[arc.target].direction, false, monitor_)) {
        hit(x, node);
      }
    }
  }
}

void DrawnArcs::cut() {
  first_piece_.assign(drawing_.nodes.size(), kNone);
  next_piece_.clear();
  std::sort(hits_.begin(), hits_.end());
  hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
  auto last = hits_.begin();
  for (std::uint32_t i = 0; i < input_.size(); ++i) {
    const Input& arc = input_[i];
    auto first = last;
    while (last != hits_.end() && last->first == i) ++last;
    if (arc.is_circle() && first == last) {
      drawing_.circle.present = true;
      drawing_.circle.plane = arc.plane;
      drawing_.circle.mark |= arc.mark;
      continue;
    }
    const std::uint32_t start = arc.is_circle() ? first->second : arc.source;
    if (arc.is_circle()) ++first;
    std::sort(first, last, [&](const auto& x, const auto& y) {
      const std::vector<Arrangement::Node>& n = drawing_.nodes;
      return x.second != y.second &&
             strictly_between_on_circle(*planes_, arc.plane, n[start].direction, n[x.second].direction,
                                        n[y.second].direction, false, monitor_);
    });
    std::uint32_t from = start;
    for (auto h = first; h != last; ++h) {
      add_piece(arc, from, h->second);
      from = h->second;
    }
    add_piece(arc, from, arc.is_circle() ? start : arc.target);
  }
}

void DrawnArcs::add_piece(const Input& arc, std::uint32_t source, std::uint32_t target) {
  PlaneId plane = arc.plane;
  if (plane.flipped()) {
    plane = plane.opposite();
    std::swap(source, target);
  }
  for (std::uint32_t k = first_piece_[source]; k != kNone; k = next_piece_[k]) {
    Arrangement::Arc& other = drawing_.arcs[k];
    if (other.plane != plane || other.target != target) continue;
    other.mark |= arc.mark;
    return;
  }
  next_piece_.push_back(first_piece_[source]);
  first_piece_[source] = static_cast<std::uint32_t>(drawing_.arcs.size());
  drawing_.arcs.push_back({plane, source, target, arc.mark, 0, 0});
}

void DrawnArcs::finish(LabelId centre, SphereMapBuffer& out) {
  drawing_.centre = centre;
  for (std::uint32_t j = 1; j < input_.size(); ++j) {
    for (std::uint32_t i = 0; i < j; ++i) cross(i, j);
  }
  cut();
  drawing_.sort_around_nodes(*planes_, monitor_);
  drawing_.simplify_and_assemble(*planes_, out, monitor_);
}

}  // namespace nef::minkowski
