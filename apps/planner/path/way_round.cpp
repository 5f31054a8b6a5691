// SPDX-License-Identifier: Apache-2.0
//
// Another way round an obstacle may be shorter than the best that pulling can make of the present
// one. Shortest paths bend at edges, so their vertices and a few points on them, joined where they
// see each other, show which way is best ([Papadimitriou 1985] milestones points on edges so that the result is as near
// to the optimum as wanted; here a few must do, since tightening follows). Where vertices and edges may not be touched
// (contact is forbidden, or roomy paths avoid them), the way is searched over them nevertheless, and then bent away
// from them.
#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/path/shorten.h"
#include "apps/planner/search/a_star.h"

namespace nef::planner {
namespace {

struct Milestone {
  Rational3 exact;
  Vector3d approximate;
};

double span(const Milestone& a, const Milestone& b) { return (a.approximate - b.approximate).norm(); }

Milestone milestone_at(const Rational3& p) { return {p, to_vector(p)}; }

// Vertices and three points on each edge; fewer if that would be too many. Nothing if the vertices alone are.
std::vector<Milestone> milestones(const FreeSpace& free, const CellFilter& filter, std::size_t limit) {
  std::vector<Milestone> result;
  const CellNumbering& cells = free.cells();
  std::size_t vertices = 0;
  std::size_t edges = 0;
  for (CellId cell = 0; cell < cells.facet(FacetId{0}); ++cell) {
    if (filter(cell)) ++(cells.dimension(cell) == 0 ? vertices : edges);
  }
  if (vertices > limit) return {};
  for (CellId cell = 0; cell < cells.facet(FacetId{0}); ++cell) {
    if (filter(cell) && cells.dimension(cell) == 0) result.push_back(milestone_at(free.vertices(cell)[0]));
  }
  const std::size_t inner = edges == 0 ? 0 : std::min<std::size_t>(3, (limit - vertices) / edges);
  for (CellId cell = 0; cell < cells.facet(FacetId{0}) && inner > 0; ++cell) {
    if (!filter(cell) || cells.dimension(cell) != 1) continue;
    const std::vector<Rational3> ends = free.vertices(cell);
    for (std::size_t k = 1; k <= inner; ++k) {
      Rational t(static_cast<unsigned long>(k), static_cast<unsigned long>(inner + 1));
      t.canonicalize();
      result.push_back(milestone_at(point_between(ends[0], ends[1], t)));
    }
  }
  return result;
}

// The shortest way from the first milestone to the second over milestones that see each other, if it is shorter than
// `upper_bound`; else none. Two milestones are asked whether they see each other only if that would improve something.
Waypoints visible_way(const FreeSpace& free, const CellFilter& filter, const std::vector<Milestone>& milestones,
                      double upper_bound) {
  constexpr AStar::Node kStart = 0;
  constexpr AStar::Node kGoal = 1;
  const auto count = static_cast<AStar::Node>(milestones.size());
  AStar search(count);
  search.offer(kStart, AStar::kNone, 0, span(milestones[kStart], milestones[kGoal]));
  while (const std::optional<AStar::Node> at = search.next()) {
    if (*at == kGoal) {
      Waypoints path;
      for (const AStar::Node node : search.way_to(kGoal)) path.push_back(milestones[node].exact);
      return path;
    }
    for (AStar::Node next = 1; next < count; ++next) {
      const double total = search.cost(*at) + span(milestones[*at], milestones[next]);
      const double estimate = total + span(milestones[next], milestones[kGoal]);
      if (!search.improves(next, total) || estimate >= upper_bound) continue;
      if (!segment_allowed(free, filter, milestones[*at].exact, milestones[next].exact)) continue;
      search.offer(next, *at, total, estimate);
    }
  }
  return {};
}

// All that the filter allows, and every vertex, edge and facet: there the shortest ways bend. Nothing if the filter
// allows these itself.
std::optional<CellFilter> with_boundaries(const FreeSpace& free, const CellFilter& filter) {
  CellFilter result = filter;
  bool any = false;
  for (CellId cell = 0; cell < free.cells().volume(kOuterVolume); ++cell) {
    any = any || !filter(cell);
    result.allow(cell);
  }
  return any ? std::optional(std::move(result)) : std::nullopt;
}

// The same way, its bends a little farther out, so that it may be used: a bend goes round an obstacle, which is on the
// side to which it turns. Nothing if that does not do.
std::optional<Waypoints> bent_away(const FreeSpace& free, const CellFilter& filter, const Waypoints& way) {
  for (const int bits : {18, 12}) {
    Waypoints moved = way;
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
      const Vector3d at = to_vector(way[i]);
      const Vector3d before = at - to_vector(way[i - 1]);
      const Vector3d after = at - to_vector(way[i + 1]);
      const Vector3d out = before.normalized() + after.normalized();
      const double step = std::ldexp(std::min(before.norm(), after.norm()), -bits);
      if (!(out.norm() > 0) || !std::isfinite(step)) return std::nullopt;
      const Vector3d there = at + step / out.norm() * out;
      for (std::size_t k = 0; k < 3; ++k) moved[i][k] = exact_rational(there[static_cast<Eigen::Index>(k)]);
    }
    if (way_allowed(free, filter, moved)) return moved;
  }
  return std::nullopt;
}

}  // namespace

void take_shorter_way_round(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t limit) {
  if (path.size() <= 2) return;
  std::vector<Milestone> all{milestone_at(path.front()), milestone_at(path.back())};
  const std::optional<CellFilter> closed = with_boundaries(free, filter);
  const std::vector<Milestone> inner = milestones(free, closed ? *closed : filter, limit);
  if (inner.empty()) return;
  all.insert(all.end(), inner.begin(), inner.end());
  const auto take_if_shorter = [&](Waypoints other) {
    shortcut(free, filter, other, false);
    tighten(free, filter, other, 40);
    if (length_of(other) < length_of(path)) path = std::move(other);
  };
  // The few points on the edges cost some length that sliding gets back: let the way be a little
  // longer than the present one.
  constexpr double kLonger = 1.2;
  Waypoints other = visible_way(free, filter, all, kLonger * length_of(path));
  if (!other.empty()) take_if_shorter(std::move(other));
  if (!closed) return;
  Waypoints touching = visible_way(free, *closed, all, kLonger * length_of(path));
  if (touching.empty()) return;
  tighten(free, *closed, touching, 40);
  if (!(length_of(touching) < length_of(path))) return;
  if (std::optional<Waypoints> beside = bent_away(free, filter, touching)) take_if_shorter(*std::move(beside));
}

}  // namespace nef::planner
