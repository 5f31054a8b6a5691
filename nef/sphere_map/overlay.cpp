// SPDX-License-Identifier: Apache-2.0
//
// 1. Nodes: the svertices of both maps, equal ones merged, and where an arc of one crosses an arc
//    of the other. Inside one map arcs do not cross, so a crossing of two interiors belongs to one
//    pair of arcs only and needs no search for equals.
// 2. Arcs are cut at the nodes inside them; pieces that coincide become one.
// 3. Around each node, the sfaces of each operand follow from the arcs that leave it. Nodes that
//    touch nothing of an operand lie in one of its sfaces, which spreads along the arcs of the
//    other; only where a whole component touches nothing, one point location is asked.
// 4. Marks by f; the drawing is simplified and assembled.
#include "nef/sphere_map/overlay.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/geometry/direction_error.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

// Above this many pairs a tree over boxes finds the candidates.
constexpr std::size_t kBrutePairs = 1024;

std::array<double, 3> unit(const Direction& d) {
  const double length = std::sqrt(d.approximate[0] * d.approximate[0] + d.approximate[1] * d.approximate[1] +
                                  d.approximate[2] * d.approximate[2]);
  return {d.approximate[0] / length, d.approximate[1] / length, d.approximate[2] / length};
}

// How far a box must reach beyond the double that stands for a direction. Let d be the vector of a direction's doubles,
// t the true vector, both with a largest component of about 1, so of length 1 at least. Each component of d - t is at
// most e = kMostDirectionError, and |d / |d| - t / |t|| <= 2 |d - t| / (|d| + |t|) (Dunkl and Williams), which is at
// most sqrt(3) e for each point. The box of an arc is around the middle of a chord, off by sqrt(3) e, with half of the
// chord's length, off by as much again: 2 sqrt(3) e in all, and a few roundings of 2^-53. (Directions from integers
// have a largest component from 1/2 on, and errors of 2^-51.)
constexpr double kSlack = 0x1p-26;
static_assert(2 * 1.7321 * kMostDirectionError + 0x1p-48 < kSlack);

Box box_around(const std::array<double, 3>& p, double radius) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = p[i] - radius;
    box.high[i] = p[i] + radius;
  }
  return box;
}

}  // namespace

void SphereOverlay::overlay(const PlaneTable& planes, const SphereMapView& a, const SphereMapView& b,
                            const LabelFunction& f, SphereMapBuffer& out, const Monitor& monitor) {
  planes_ = &planes;
  monitor_ = monitor;
  maps_ = {a, b};
  drawing_.clear();
  support_.clear();
  input_.clear();
  hits_.clear();
  owners_.clear();
  circle_owner_.clear();
  load(a, 0);
  const auto first_of_b = static_cast<std::uint32_t>(input_.size());
  load(b, 1);
  cross_arcs(first_of_b);
  place_isolated(first_of_b);
  cut_arcs();
  drawing_.sort_around_nodes(planes, monitor);
  face_.assign(2 * drawing_.arcs.size(), {kNone, kNone});
  node_face_.assign(drawing_.nodes.size(), {kNone, kNone});
  find_faces(0);
  find_faces(1);
  evaluate(f);
  drawing_.simplify_and_assemble(planes, out, monitor);
}

void SphereOverlay::load(const SphereMapView& map, std::uint8_t operand) {
  const auto first_node = static_cast<std::uint32_t>(drawing_.nodes.size());
  node_of_b_.clear();
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    Arrangement::Node node;
    node.direction = direction_of(*planes_, map.svertices[i]);
    drawing_.nodes.push_back(std::move(node));
    support_.emplace_back();
    support_.back().kind[operand] = Support::kVertex;
    support_.back().index[operand] = i;
    node_of_b_.push_back(first_node + i);
  }
  if (operand == 1) merge_nodes(first_node);
  for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) {
    input_.push_back(
        {map.shalfedges[i].plane, node_of_b_[map.shalfedges[i].source], node_of_b_[map.target(i)], i, operand});
  }
  if (!map.sloops.empty()) input_.push_back({map.sloops[0].plane, kNone, kNone, 0, operand});
}

// Nodes first_of_b.. are those of b; equal ones of a take their place.
void SphereOverlay::merge_nodes(std::uint32_t first_of_b) {
  std::vector<Arrangement::Node>& nodes = drawing_.nodes;
  const auto count = static_cast<std::uint32_t>(nodes.size());
  std::uint32_t kept = first_of_b;
  BoxTree tree;
  const bool large = static_cast<std::size_t>(first_of_b) * (count - first_of_b) > kBrutePairs;
  if (large) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < first_of_b; ++i) boxes.push_back(box_around(unit(nodes[i].direction), kSlack));
    tree = BoxTree(boxes);
  }
  for (std::uint32_t j = first_of_b; j < count; ++j) {
    std::uint32_t found = kNone;
    if (large) {
      tree.for_each_overlap(box_around(unit(nodes[j].direction), kSlack), [&](std::uint32_t i) {
        if (found == kNone && same_direction(nodes[i].direction, nodes[j].direction, monitor_)) found = i;
      });
    } else {
      for (std::uint32_t i = 0; i < first_of_b && found == kNone; ++i) {
        if (same_direction(nodes[i].direction, nodes[j].direction, monitor_)) found = i;
      }
    }
    if (found != kNone) {
      support_[found].kind[1] = Support::kVertex;
      support_[found].index[1] = j - first_of_b;
      node_of_b_[j - first_of_b] = found;
      continue;
    }
    node_of_b_[j - first_of_b] = kept;
    if (kept != j) {
      nodes[kept] = std::move(nodes[j]);
      support_[kept] = support_[j];
    }
    ++kept;
  }
  nodes.resize(kept);
  support_.resize(kept);
}

void SphereOverlay::cross_arcs(std::uint32_t first_of_b) {
  const auto count = static_cast<std::uint32_t>(input_.size());
  if (static_cast<std::size_t>(first_of_b) * (count - first_of_b) <= kBrutePairs) {
    for (std::uint32_t i = 0; i < first_of_b; ++i) {
      for (std::uint32_t j = first_of_b; j < count; ++j) cross_pair(i, j);
    }
    return;
  }
  // An arc of at most a half circle lies in the ball around the middle of its chord that has the
  // chord as diameter.
  const auto box_of = [this](const InputArc& arc) {
    Box everywhere = box_around({0, 0, 0}, 2);
    if (arc.source == kNone || arc.source == arc.target) return everywhere;
    const Direction& s = drawing_.nodes[arc.source].direction;
    const Direction& t = drawing_.nodes[arc.target].direction;
    if (orientation_on_circle(*planes_, arc.plane, s, t, monitor_) <= 0) return everywhere;
    const std::array<double, 3> u = unit(s);
    const std::array<double, 3> v = unit(t);
    const double chord =
        std::sqrt((u[0] - v[0]) * (u[0] - v[0]) + (u[1] - v[1]) * (u[1] - v[1]) + (u[2] - v[2]) * (u[2] - v[2]));
    return box_around({(u[0] + v[0]) / 2, (u[1] + v[1]) / 2, (u[2] + v[2]) / 2}, chord / 2 + kSlack);
  };
  std::vector<Box> boxes;
  for (std::uint32_t j = first_of_b; j < count; ++j) boxes.push_back(box_of(input_[j]));
  const BoxTree tree(boxes);
  for (std::uint32_t i = 0; i < first_of_b; ++i) {
    tree.for_each_overlap(box_of(input_[i]), [&](std::uint32_t j) { cross_pair(i, first_of_b + j); });
  }
}

void SphereOverlay::hit(std::uint32_t node, std::uint32_t arc) {
  const InputArc& a = input_[arc];
  NodeSupport& support = support_[node];
  if (support.kind[a.operand] == Support::kVertex) return;
  support.kind[a.operand] = Support::kArc;
  support.index[a.operand] = a.item | (a.source == kNone ? kLoopOwner : 0U);
  hits_.emplace_back(arc, node);
}

// Sides of the ends of an arc by the circle of another one; nothing to know of a loop.
SphereOverlay::EndSides SphereOverlay::sides_of_ends(const InputArc& arc, const InputArc& other) const {
  if (arc.source == kNone) return {};
  const auto side = [&](std::uint32_t node) {
    if (node == other.source || node == other.target) return 0;
    return side_of_circle(*planes_, other.plane, drawing_.nodes[node].direction, monitor_);
  };
  const int from = side(arc.source);
  return {from, arc.source == arc.target ? from : side(arc.target)};
}

// An arc whose ends lie on one side of a circle crosses it twice if it is longer than a half circle, or else never.
bool SphereOverlay::stays_aside(const InputArc& arc, const EndSides& sides) const {
  if (arc.source == kNone || arc.source == arc.target || sides.from == 0 || sides.from != sides.to) return false;
  return orientation_on_circle(*planes_, arc.plane, drawing_.nodes[arc.source].direction,
                               drawing_.nodes[arc.target].direction, monitor_) >= 0;
}

// Whether `arc`, whose ends are on these sides of another circle, passes through, or ends at, the crossing of its
// circle with that one that lies at n_arc x n_other (first_crossing: there the arc's circle goes from the positive to
// the negative side of the other plane) or at its antipode. end_node is set if it ends there. Not for one that stays
// aside.
bool SphereOverlay::crosses_at(const InputArc& arc, const EndSides& sides, const Direction& crossing,
                               bool first_crossing, std::uint32_t& end_node) const {
  end_node = kNone;
  if (arc.source == kNone) return true;
  const Direction& s = drawing_.nodes[arc.source].direction;
  const Direction& t = drawing_.nodes[arc.target].direction;
  auto [from, to] = sides;
  // An end on the other circle is at this crossing or at the antipode; both are far apart, so the
  // filter always answers.
  if (from == 0) {
    if (sign_of_dot(s, crossing, monitor_) > 0) {
      end_node = arc.source;
      return true;
    }
    from = first_crossing ? 1 : -1;  // it starts at the antipode and heads for this crossing
    if (to == 0 && arc.source != arc.target) {
      end_node = sign_of_dot(t, crossing, monitor_) > 0 ? arc.target : kNone;
      return true;  // a half circle to it, or from the antipode around to itself: the latter is excluded
    }
    if (arc.source == arc.target) return true;
    return to != from;
  }
  if (to == 0) {
    if (sign_of_dot(t, crossing, monitor_) > 0) {
      end_node = arc.target;
      return true;
    }
    // It ends at the antipode, so it was there last; it met this crossing iff it started before.
    return from == (first_crossing ? 1 : -1);
  }
  return from == to || first_crossing == (from > 0);
}

void SphereOverlay::cross_pair(std::uint32_t arc_a, std::uint32_t arc_b) {
  const InputArc a = input_[arc_a];
  const InputArc b = input_[arc_b];
  if (a.plane.row() == b.plane.row()) {
    cross_coplanar(arc_a, arc_b);
    return;
  }
  const EndSides of_a = sides_of_ends(a, b);
  if (stays_aside(a, of_a)) return;
  const EndSides of_b = sides_of_ends(b, a);
  if (stays_aside(b, of_b)) return;
  Direction crossing = Direction::cross(*planes_, a.plane, b.plane);
  for (int k = 0; k < 2; ++k) {
    if (k == 1) crossing = crossing.negated();
    std::uint32_t end_a = kNone;
    std::uint32_t end_b = kNone;
    // Seen from b, the crossing n_a x n_b is the antipode of n_b x n_a.
    if (!crosses_at(a, of_a, crossing, k == 0, end_a) || !crosses_at(b, of_b, crossing, k == 1, end_b)) continue;
    if (end_a != kNone && end_b != kNone) {
      NEF_ASSERT(end_a == end_b);
    } else if (end_a != kNone) {
      hit(end_a, arc_b);
    } else if (end_b != kNone) {
      hit(end_b, arc_a);
    } else {
      const auto node = static_cast<std::uint32_t>(drawing_.nodes.size());
      Arrangement::Node crossing_node;
      crossing_node.direction = crossing;
      drawing_.nodes.push_back(std::move(crossing_node));
      support_.emplace_back();
      hit(node, arc_a);
      hit(node, arc_b);
    }
  }
}

// Arcs on one great circle meet in their ends only; the pieces are found when both are cut.
void SphereOverlay::cross_coplanar(std::uint32_t arc_a, std::uint32_t arc_b) {
  for (int k = 0; k < 2; ++k) {
    const std::uint32_t i = k == 0 ? arc_a : arc_b;
    const InputArc arc = input_[i];
    const InputArc other = input_[k == 0 ? arc_b : arc_a];
    if (other.source == kNone) continue;
    for (const std::uint32_t node : {other.source, other.target}) {
      if (arc.source == kNone) {
        hit(node, i);
      } else if (node != arc.source && node != arc.target) {
        const std::vector<Arrangement::Node>& n = drawing_.nodes;
        if (strictly_between_on_circle(*planes_, arc.plane, n[arc.source].direction, n[node].direction,
                                       n[arc.target].direction, arc.source == arc.target, monitor_)) {
          hit(node, i);
        }
      }
    }
  }
}

// Isolated svertices take no part in pairs of arcs.
void SphereOverlay::place_isolated(std::uint32_t first_of_b) {
  for (std::uint32_t node = 0; node < support_.size(); ++node) {
    for (std::uint32_t operand = 0; operand < 2; ++operand) {
      const NodeSupport& support = support_[node];
      if (support.kind[operand] != Support::kVertex || support.kind[1 - operand] != Support::kUnknown) continue;
      if (maps_[operand].svertices[support.index[operand]].out != kNone) continue;
      const std::uint32_t first = operand == 0 ? first_of_b : 0;
      const auto last = operand == 0 ? static_cast<std::uint32_t>(input_.size()) : first_of_b;
      for (std::uint32_t i = first; i < last; ++i) {
        const InputArc& arc = input_[i];
        const std::vector<Arrangement::Node>& n = drawing_.nodes;
        if (side_of_circle(*planes_, arc.plane, n[node].direction, monitor_) != 0) continue;
        if (arc.source == kNone ||
            strictly_between_on_circle(*planes_, arc.plane, n[arc.source].direction, n[node].direction,
                                       n[arc.target].direction, arc.source == arc.target, monitor_)) {
          hit(node, i);
          break;
        }
      }
    }
  }
}

void SphereOverlay::cut_arcs() {
  first_piece_.assign(drawing_.nodes.size(), kNone);
  next_piece_.clear();
  std::sort(hits_.begin(), hits_.end());
  hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
  auto hit = hits_.begin();
  for (std::uint32_t i = 0; i < input_.size(); ++i) {
    const InputArc& arc = input_[i];
    const auto first = hit;
    while (hit != hits_.end() && hit->first == i) ++hit;
    if (arc.source == kNone && first == hit) {
      if (circle_owner_.empty()) circle_owner_.push_back({kNone, kNone});
      const bool flip = drawing_.circle.present && drawing_.circle.plane != arc.plane;
      drawing_.circle.present = true;
      if (!flip) drawing_.circle.plane = arc.plane;
      circle_owner_[0][arc.operand] = (flip ? 1U : 0U) | kLoopOwner;
      continue;
    }
    const std::vector<Arrangement::Node>& n = drawing_.nodes;
    const std::uint32_t start = arc.source == kNone ? first->second : arc.source;
    const bool closed = arc.source == kNone || arc.source == arc.target;
    std::sort(first, hit, [&](const auto& x, const auto& y) {
      if (x.second == y.second || y.second == start) return false;
      if (x.second == start) return true;
      const Direction& s = n[start].direction;
      return strictly_between_on_circle(*planes_, arc.plane, s, n[x.second].direction, n[y.second].direction, false,
                                        monitor_);
    });
    std::uint32_t from = start;
    for (auto h = first; h != hit; ++h) {
      if (h->second == start) continue;
      add_piece(arc, from, h->second);
      from = h->second;
    }
    add_piece(arc, from, closed ? start : arc.target);
  }
}

void SphereOverlay::add_piece(const InputArc& arc, std::uint32_t source, std::uint32_t target) {
  std::uint32_t owner = arc.item | (arc.source == kNone ? kLoopOwner : 0U);
  PlaneId plane = arc.plane;
  if (plane.flipped()) {
    plane = plane.opposite();
    std::swap(source, target);
    owner ^= 1U;
  }
  if (arc.operand == 1) {
    // A piece of a may be the same.
    for (std::uint32_t k = first_piece_[source]; k != kNone; k = next_piece_[k]) {
      const Arrangement::Arc& other = drawing_.arcs[k];
      if (other.plane == plane && other.target == target) {
        owners_[k][1] = owner;
        return;
      }
    }
  }
  Arrangement::Arc piece;
  piece.plane = plane;
  piece.source = source;
  piece.target = target;
  next_piece_.push_back(first_piece_[source]);
  first_piece_[source] = static_cast<std::uint32_t>(drawing_.arcs.size());
  drawing_.arcs.push_back(piece);
  owners_.push_back({kNone, kNone});
  owners_.back()[arc.operand] = owner;
}

std::uint32_t SphereOverlay::face_left_of(int operand, std::uint32_t owner) const {
  const SphereMapView& map = maps_[static_cast<std::size_t>(operand)];
  if ((owner & kLoopOwner) != 0) return map.sloops[owner & ~kLoopOwner].sface;
  return map.shalfedges[owner].sface;
}

LabelId SphereOverlay::mark_of_owner(int operand, std::uint32_t owner) const {
  const SphereMapView& map = maps_[static_cast<std::size_t>(operand)];
  if ((owner & kLoopOwner) != 0) return map.sloops[owner & ~kLoopOwner].mark;
  return map.shalfedges[owner].mark;
}

// For every half of the drawing, the sface of `operand` to its left.
void SphereOverlay::find_faces(int operand) {
  const auto x = static_cast<std::size_t>(operand);
  const SphereMapView& map = maps_[x];
  if (map.trivial()) {
    for (auto& face : face_) face[x] = 0;
    for (auto& face : node_face_) face[x] = 0;
    return;
  }
  const auto owner_of = [&](std::uint32_t half) {
    const std::uint32_t owner = owners_[half >> 1U][x];
    return owner == kNone ? kNone : owner ^ (half & 1U);
  };
  std::vector<std::uint32_t> queue;
  std::vector<bool> known(drawing_.nodes.size(), false);
  for (std::uint32_t node = 0; node < drawing_.nodes.size(); ++node) {
    const std::span<const std::uint32_t> ring = drawing_.around(node);
    std::size_t first = 0;
    while (first < ring.size() && owner_of(ring[first]) == kNone) ++first;
    if (first < ring.size()) {
      std::uint32_t face = kNone;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t half = ring[(first + i) % ring.size()];
        if (const std::uint32_t owner = owner_of(half); owner != kNone) face = face_left_of(operand, owner);
        face_[half][x] = face;
      }
    } else if (support_[node].kind[x] == Support::kVertex) {
      node_face_[node][x] = map.svertices[support_[node].index[x]].sface;
    } else {
      continue;
    }
    known[node] = true;
    queue.push_back(node);
  }
  const auto settle = [&](std::uint32_t node, std::uint32_t face) {
    node_face_[node][x] = face;
    known[node] = true;
    queue.push_back(node);
  };
  const auto spread = [&] {
    while (!queue.empty()) {
      const std::uint32_t node = queue.back();
      queue.pop_back();
      const std::uint32_t own = node_face_[node][x];
      for (const std::uint32_t half : drawing_.around(node)) {
        if (own != kNone) face_[half][x] = own;
        const std::uint32_t other = drawing_.target(half);
        if (!known[other]) settle(other, face_[half][x]);
      }
    }
  };
  spread();
  for (std::uint32_t node = 0; node < drawing_.nodes.size(); ++node) {
    if (known[node]) continue;
    const SphereLocation where = locate(*planes_, map, drawing_.nodes[node].direction, monitor_);
    NEF_ASSERT(where.kind == SphereLocation::Kind::kSFace);
    settle(node, where.index);
    spread();
  }
}

void SphereOverlay::evaluate(const LabelFunction& f) {
  const auto face_mark = [this](std::size_t x, std::uint32_t face) { return maps_[x].sfaces[face].mark; };
  const auto left_label = [&](std::uint32_t half) {
    return f(face_mark(0, face_[half][0]), face_mark(1, face_[half][1]));
  };
  drawing_.centre = f(maps_[0].mark, maps_[1].mark);
  drawing_.background = f(maps_[0].sfaces[0].mark, maps_[1].sfaces[0].mark);
  for (std::uint32_t k = 0; k < drawing_.arcs.size(); ++k) {
    std::array<LabelId, 2> mark{};
    for (std::size_t x = 0; x < 2; ++x) {
      mark[x] =
          owners_[k][x] != kNone ? mark_of_owner(static_cast<int>(x), owners_[k][x]) : face_mark(x, face_[2 * k][x]);
    }
    drawing_.arcs[k].mark = f(mark[0], mark[1]);
    drawing_.arcs[k].left = left_label(2 * k);
    drawing_.arcs[k].right = left_label(2 * k + 1);
  }
  for (std::uint32_t node = 0; node < drawing_.nodes.size(); ++node) {
    const NodeSupport& support = support_[node];
    const std::span<const std::uint32_t> ring = drawing_.around(node);
    std::array<LabelId, 2> mark{};
    std::array<LabelId, 2> around{};
    for (std::size_t x = 0; x < 2; ++x) {
      const std::uint32_t face = ring.empty() ? node_face_[node][x] : face_[ring[0]][x];
      around[x] = face_mark(x, face);
      if (support.kind[x] == Support::kVertex) {
        mark[x] = maps_[x].svertices[support.index[x]].mark;
      } else if (support.kind[x] == Support::kArc) {
        mark[x] = mark_of_owner(static_cast<int>(x), support.index[x]);
      } else {
        mark[x] = around[x];
      }
    }
    drawing_.nodes[node].mark = f(mark[0], mark[1]);
    drawing_.nodes[node].around = f(around[0], around[1]);
  }
  if (!drawing_.circle.present) return;
  const Direction n = Direction::normal(*planes_, drawing_.circle.plane);
  std::array<std::array<LabelId, 2>, 3> labels{};  // mark, left, right of each operand
  for (std::size_t x = 0; x < 2; ++x) {
    const std::uint32_t owner = circle_owner_[0][x];
    if (owner != kNone) {
      labels[0][x] = mark_of_owner(static_cast<int>(x), owner);
      labels[1][x] = face_mark(x, face_left_of(static_cast<int>(x), owner));
      labels[2][x] = face_mark(x, face_left_of(static_cast<int>(x), owner ^ 1U));
      continue;
    }
    // The whole circle lies in one sface of this operand: any of its points tells which.
    const Integer3& v = n.integers();
    const Direction point =
        v[0] == 0 && v[1] == 0 ? Direction::exact(1, 0, 0) : Direction::exact(Integer(-v[1]), v[0], 0);
    const LabelId label =
        maps_[x].trivial() ? face_mark(x, 0) : mark_at(maps_[x], locate(*planes_, maps_[x], point, monitor_));
    labels[0][x] = labels[1][x] = labels[2][x] = label;
  }
  drawing_.circle.mark = f(labels[0][0], labels[0][1]);
  drawing_.circle.left = f(labels[1][0], labels[1][1]);
  drawing_.circle.right = f(labels[2][0], labels[2][1]);
}

}  // namespace nef
