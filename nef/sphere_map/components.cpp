// SPDX-License-Identifier: Apache-2.0
//
// Each component is joined to the first (or to the sloop, if there is one) by a walk along great
// circle segments. Between two consecutive things that the walk meets it stays in one sface, so
// the cycles on both sides of such a gap bound the same sface. The walk ends at the first
// component, so the gaps of all walks together connect all components; and on a sphere that is
// all there is to join.
#include "nef/sphere_map/components.h"

#include <algorithm>

#include "nef/base/defect.h"
#include "nef/base/union_find.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

class CycleJoiner {
 public:
  CycleJoiner(const PlaneTable& planes, const SphereMapView& map, const std::vector<std::uint32_t>& of_half,
              const std::vector<std::uint32_t>& of_vertex, UnionFind& cycles, const Monitor& monitor)
      : planes_(planes), map_(map), of_half_(of_half), of_vertex_(of_vertex), cycles_(cycles), monitor_(monitor) {
    directions_.reserve(map.svertices.size());
    for (const SVertex& v : map.svertices) directions_.push_back(direction_of(planes, v));
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
      const SHalfedge& arc = map.shalfedges[e];
      const std::uint32_t t = map.target(e);
      short_.push_back(arc.source != t &&
                       orientation_on_circle(planes, arc.plane, directions_[arc.source], directions_[t], monitor_) > 0);
    }
  }

  // From svertex `start` to svertex `goal`.
  void walk_to_vertex(std::uint32_t start, std::uint32_t goal) {
    const Direction& u = directions_[start];
    const Direction& v = directions_[goal];
    if (!same_direction(u, v.negated(), monitor_)) {
      const std::uint32_t last = segment(u, v, cycle_at(start, Direction::cross(u, v)), goal);
      cycles_.unite(last, cycle_arriving(goal, Direction::cross(v, u)));
      return;
    }
    // Antipodes: by way of a point of some sface.
    const Direction middle = free_direction();
    const std::uint32_t half_way = segment(u, middle, cycle_at(start, Direction::cross(u, middle)), kNone);
    const std::uint32_t last = segment(middle, v, half_way, goal);
    cycles_.unite(last, cycle_arriving(goal, Direction::cross(v, middle)));
  }

  // From svertex `start` to the nearest point of the great circle of a sloop.
  void walk_to_loop(std::uint32_t start, const std::vector<std::uint32_t>& of_loop) {
    const Direction& u = directions_[start];
    const Direction n = Direction::normal(planes_, map_.sloops[0].plane);
    const int side = sign_of_dot(n, u, monitor_);
    detail::require(side != 0, "an svertex lies beside the circle of an sloop", {{"svertex", start}});
    // u x n is zero where u is the pole; then any direction on the circle is as near.
    const Direction axis = Direction::cross(u, n);
    const Direction foot = axis.is_zero() ? any_orthogonal(n) : Direction::cross(n, axis);
    const std::uint32_t last = segment(u, foot, cycle_at(start, Direction::cross(u, foot)), kNone);
    cycles_.unite(last, of_loop[side > 0 ? 0 : 1]);
  }

 private:
  struct Hit {
    Direction at;
    bool is_vertex;
    std::uint32_t index;  // svertex, or the shalfedge on whose left the walk arrives
  };

  static Direction any_orthogonal(const Direction& n) {
    const Integer3& v = n.integers();
    return v[0] == 0 && v[1] == 0 ? Direction::exact(1, 0, 0) : Direction::exact(Integer(-v[1]), v[0], 0);
  }

  // The cycle of the wedge of svertex i that the half-plane of `normal` enters; where it runs
  // along a shalfedge, the cycle to the left of someone who walks along it.
  std::uint32_t cycle_at(std::uint32_t i, const Direction& normal) const {
    if (map_.svertices[i].out == kNone) return of_vertex_[i];
    return of_half_[locate_wedge(planes_, map_, i, normal, monitor_).shalfedge];
  }
  // The same for someone who arrives: `back` points where he comes from.
  std::uint32_t cycle_arriving(std::uint32_t i, const Direction& back) const {
    if (map_.svertices[i].out == kNone) return of_vertex_[i];
    const Wedge wedge = locate_wedge(planes_, map_, i, back, monitor_);
    return wedge.on ? of_half_[wedge.shalfedge ^ 1U] : of_half_[wedge.shalfedge];
  }

  // Unites along the open segment from u to v; returns the cycle in whose sface it ends.
  std::uint32_t segment(const Direction& u, const Direction& v, std::uint32_t current, std::uint32_t goal) {
    const Direction circle = Direction::cross(u, v);
    std::vector<Hit> hits;
    side_.resize(directions_.size());
    for (std::uint32_t i = 0; i < directions_.size(); ++i) {
      const Direction& x = directions_[i];
      side_[i] = sign_of_dot(circle, x, monitor_);
      if (i == goal || side_[i] != 0) continue;
      if (sign_of_determinant(circle, u, x, monitor_) <= 0 || sign_of_determinant(circle, x, v, monitor_) <= 0)
        continue;
      hits.push_back({x, true, i});
    }
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); i += 2) {
      const SHalfedge& arc = map_.shalfedges[i];
      const std::uint32_t t = map_.target(i);
      // Less than a half circle crosses another circle only if its ends lie on either side.
      if (short_[i / 2] && side_[arc.source] * side_[t] >= 0) continue;
      const Direction n = Direction::normal(planes_, arc.plane);
      const int side = sign_of_dot(n, u, monitor_);
      if (side * sign_of_dot(n, v, monitor_) >= 0) continue;
      Direction x = Direction::cross(circle, n);
      if (side < 0) x = x.negated();
      const Direction& from = directions_[arc.source];
      const Direction& to = directions_[t];
      if (same_direction(x, from, monitor_) || same_direction(x, to, monitor_)) continue;
      if (!strictly_between_on_circle(planes_, arc.plane, from, x, to, arc.source == t, monitor_)) continue;
      hits.push_back({std::move(x), false, side > 0 ? i : i + 1});
    }
    std::sort(hits.begin(), hits.end(),
              [&](const Hit& a, const Hit& b) { return sign_of_determinant(circle, a.at, b.at, monitor_) > 0; });
    for (const Hit& hit : hits) {
      if (hit.is_vertex) {
        cycles_.unite(current, cycle_arriving(hit.index, Direction::cross(hit.at, u)));
        current = cycle_at(hit.index, Direction::cross(hit.at, v));
      } else {
        cycles_.unite(current, of_half_[hit.index]);
        current = of_half_[hit.index ^ 1U];
      }
    }
    return current;
  }

  // A direction on no item of the map: among enough small vectors of which no great circle holds
  // more than a few, one is free.
  [[nodiscard]] Direction free_direction() const {
    for (int k = 1;; ++k) {
      Direction candidate = Direction::exact(1, k, k * k);
      bool free = true;
      for (std::uint32_t i = 0; i < map_.shalfedges.size() && free; i += 2) {
        free = side_of_circle(planes_, map_.shalfedges[i].plane, candidate, monitor_) != 0;
      }
      for (std::uint32_t i = 0; i < map_.svertices.size() && free; ++i) {
        const Direction& x = directions_[i];
        free = !same_direction(x, candidate, monitor_) && !same_direction(x.negated(), candidate, monitor_);
      }
      if (free) return candidate;
    }
  }

  const PlaneTable& planes_;
  const SphereMapView& map_;
  const std::vector<std::uint32_t>& of_half_;
  const std::vector<std::uint32_t>& of_vertex_;
  UnionFind& cycles_;
  Monitor monitor_;
  std::vector<Direction> directions_;  // of the svertices
  std::vector<bool> short_;            // of each pair of shalfedges: less than a half circle
  std::vector<int> side_;              // of each svertex beside the circle of the current walk
};

}  // namespace

std::vector<std::uint32_t> join_cycles(const PlaneTable& planes, const SphereMapView& map,
                                       const std::vector<std::uint32_t>& of_half,
                                       const std::vector<std::uint32_t>& of_vertex,
                                       const std::vector<std::uint32_t>& of_loop, std::uint32_t cycle_count,
                                       const Monitor& monitor) {
  UnionFind cycles(cycle_count);
  UnionFind components(map.svertices.size());
  std::size_t count = map.svertices.size();
  for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) {
    if (components.unite(map.shalfedges[i].source, map.target(i))) --count;
  }
  if (count + (of_loop.empty() ? 0 : 1) > 1) {
    CycleJoiner joiner(planes, map, of_half, of_vertex, cycles, monitor);
    for (std::uint32_t v = 0; v < map.svertices.size(); ++v) {
      if (components.find(v) != v) continue;
      if (!of_loop.empty()) {
        joiner.walk_to_loop(v, of_loop);
      } else if (v != 0) {
        joiner.walk_to_vertex(v, 0);
      }
    }
  }
  std::vector<std::uint32_t> representative(cycle_count);
  for (std::uint32_t c = 0; c < cycle_count; ++c) representative[c] = cycles.find(c);
  return representative;
}

}  // namespace nef
