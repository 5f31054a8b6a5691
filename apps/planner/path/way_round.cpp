// SPDX-License-Identifier: Apache-2.0
//
// Another way round an obstacle may be shorter than the best that pulling can make of the present
// one. Shortest paths bend at edges, so their vertices and a few points on them, joined where they
// see each other, show which way is best.
#include <algorithm>
#include <cmath>
#include <queue>

#include "apps/planner/free_space/vectors.h"
#include "apps/planner/path/shorten.h"

namespace nef::planner {
namespace {

struct Place {
  Rational3 exact;
  Vector approximate{};
};

double span(const Place& a, const Place& b) { return planner::span(a.approximate, b.approximate); }

Place make_place(const Rational3& p) { return {p, to_double(p)}; }

// Vertices and three points on each edge; fewer if that would be too many.
std::vector<Place> places(const FreeSpace& free, const CellFilter& filter, std::size_t limit) {
  std::vector<Place> result;
  const CellNumbering& cells = free.cells();
  std::size_t edges = 0;
  for (CellId cell = 0; cell < cells.facet(0); ++cell) {
    if (!filter(cell)) continue;
    if (cells.dimension(cell) == 0) {
      result.push_back(make_place(free.vertices(cell)[0]));
    } else {
      ++edges;
    }
  }
  const std::size_t inner =
      edges == 0 || result.size() > limit ? 0 : std::min<std::size_t>(3, (limit - result.size()) / edges);
  for (CellId cell = 0; cell < cells.facet(0) && inner > 0; ++cell) {
    if (!filter(cell) || cells.dimension(cell) != 1) continue;
    const std::vector<Rational3> ends = free.vertices(cell);
    for (std::size_t k = 1; k <= inner; ++k) {
      Rational t(static_cast<unsigned long>(k), static_cast<unsigned long>(inner + 1));
      t.canonicalize();
      Rational3 x = ends[0];
      for (std::size_t i = 0; i < 3; ++i) x[i] += t * (ends[1][i] - ends[0][i]);
      result.push_back(make_place(x));
    }
  }
  return result;
}

// A* whose edges are checked only when they would improve something.
Waypoints visible_way(const FreeSpace& free, const CellFilter& filter, const std::vector<Place>& places,
                      double upper_bound) {
  const std::size_t goal = 1;
  std::vector<double> cost(places.size(), HUGE_VAL);
  std::vector<std::size_t> from(places.size(), 0);
  std::vector<bool> settled(places.size(), false);
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>>
      queue;
  cost[0] = 0;
  queue.emplace(span(places[0], places[goal]), 0);
  while (!queue.empty()) {
    const std::size_t at = queue.top().second;
    queue.pop();
    if (settled[at]) continue;
    settled[at] = true;
    if (at == goal) break;
    for (std::size_t next = 1; next < places.size(); ++next) {
      if (settled[next]) continue;
      const double total = cost[at] + span(places[at], places[next]);
      const double estimate = total + span(places[next], places[goal]);
      if (!(total < cost[next]) || estimate >= upper_bound) continue;
      if (!segment_allowed(free, filter, places[at].exact, places[next].exact)) continue;
      cost[next] = total;
      from[next] = at;
      queue.emplace(estimate, next);
    }
  }
  Waypoints path;
  if (!settled[goal]) return path;
  for (std::size_t at = goal; at != 0; at = from[at]) path.push_back(places[at].exact);
  path.push_back(places[0].exact);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

void take_shorter_way_round(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t limit) {
  if (path.size() <= 2) return;
  std::vector<Place> all{make_place(path.front()), make_place(path.back())};
  const std::vector<Place> inner = places(free, filter, limit);
  if (inner.size() > limit) return;
  all.insert(all.end(), inner.begin(), inner.end());
  // The few points on the edges cost some length that sliding gets back: let the way be a little
  // longer than the present one.
  Waypoints other = visible_way(free, filter, all, 1.2 * length_of(path));
  if (other.empty()) return;
  shortcut(free, filter, other, false);
  tighten(free, filter, other, 40);
  if (length_of(other) < length_of(path)) path = std::move(other);
}

}  // namespace nef::planner
