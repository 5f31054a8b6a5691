// SPDX-License-Identifier: Apache-2.0
//
// Another way round an obstacle may be shorter than the best that pulling can make of the present
// one. Shortest paths bend at edges, so their vertices and a few points on them, joined where they
// see each other, show which way is best ([Papadimitriou 1985] places points on edges so that the result is as near to
// the optimum as wanted; here a few must do, since tightening follows).
#include <algorithm>

#include "apps/planner/free_space/vectors.h"
#include "apps/planner/path/shorten.h"
#include "apps/planner/search/a_star.h"

namespace nef::planner {
namespace {

struct Place {
  Rational3 exact;
  Vector3d approximate;
};

double span(const Place& a, const Place& b) { return (a.approximate - b.approximate).norm(); }

Place make_place(const Rational3& p) { return {p, to_vector(p)}; }

// Vertices and three points on each edge; fewer if that would be too many. Nothing if the vertices alone are.
std::vector<Place> places(const FreeSpace& free, const CellFilter& filter, std::size_t limit) {
  std::vector<Place> result;
  const CellNumbering& cells = free.cells();
  std::size_t vertices = 0;
  std::size_t edges = 0;
  for (CellId cell = 0; cell < cells.facet(FacetId{0}); ++cell) {
    if (filter(cell)) ++(cells.dimension(cell) == 0 ? vertices : edges);
  }
  if (vertices > limit) return {};
  for (CellId cell = 0; cell < cells.facet(FacetId{0}); ++cell) {
    if (filter(cell) && cells.dimension(cell) == 0) result.push_back(make_place(free.vertices(cell)[0]));
  }
  const std::size_t inner = edges == 0 ? 0 : std::min<std::size_t>(3, (limit - vertices) / edges);
  for (CellId cell = 0; cell < cells.facet(FacetId{0}) && inner > 0; ++cell) {
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

// The shortest way from the first place to the second over places that see each other, if it is shorter than
// `upper_bound`; else none. Two places are asked whether they see each other only if that would improve something.
Waypoints visible_way(const FreeSpace& free, const CellFilter& filter, const std::vector<Place>& places,
                      double upper_bound) {
  constexpr AStar::Node kStart = 0;
  constexpr AStar::Node kGoal = 1;
  const auto count = static_cast<AStar::Node>(places.size());
  AStar search(count);
  search.offer(kStart, AStar::kNone, 0, span(places[kStart], places[kGoal]));
  while (const std::optional<AStar::Node> at = search.next()) {
    if (*at == kGoal) {
      Waypoints path;
      for (const AStar::Node node : search.way_to(kGoal)) path.push_back(places[node].exact);
      return path;
    }
    for (AStar::Node next = 1; next < count; ++next) {
      const double total = search.cost(*at) + span(places[*at], places[next]);
      const double estimate = total + span(places[next], places[kGoal]);
      if (!search.improves(next, total) || estimate >= upper_bound) continue;
      if (!segment_allowed(free, filter, places[*at].exact, places[next].exact)) continue;
      search.offer(next, *at, total, estimate);
    }
  }
  return {};
}

}  // namespace

void take_shorter_way_round(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t limit) {
  if (path.size() <= 2) return;
  std::vector<Place> all{make_place(path.front()), make_place(path.back())};
  const std::vector<Place> inner = places(free, filter, limit);
  if (inner.empty()) return;
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
