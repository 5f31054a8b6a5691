// SPDX-License-Identifier: Apache-2.0
//
// A* over cubes of which those that the boundary enters are dear, in the way of [Bohlin, Kavraki 2000]: what a way
// through such cubes is worth is found out when one is wanted. There free space is cut out, and its roadmap tells.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "apps/planner/search/grid_steps.h"
#include "apps/planner/search/search.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

using Cube = EmptyGrid::Cube;
using Points = std::vector<Rational3>;

// What a step into a cube costs, times its length: nothing enters it; a tight passage or a place where volumes touch is
// in it or beside it; other boundary is. What is closed is never entered.
using Price = std::uint8_t;
constexpr Price kClosed = 0;
constexpr Price kEmpty = 1;
constexpr Price kPassage = 4;
constexpr Price kEntered = 32;
constexpr double kHaste = 1.02;           // the estimates are exact in empty country: a hair more breaks ties forward
constexpr int kCuts = 8;                  // so many are tried in vain
constexpr std::size_t kSmallPart = 1000;  // a roadmap of more cells than so many, or an eighth of all, is not made
constexpr std::uint32_t kMargin = 2;      // cubes around those that a cut is for

class CorridorSearch {
 public:
  CorridorSearch(const FreeSpace& free, const CellFilter& filter, int min_dimension, const Rational3& start,
                 const Rational3& goal, const Monitor& monitor)
      : free_(free),
        filter_(filter),
        min_dimension_(min_dimension),
        monitor_(monitor),
        grid_(free.grid(monitor)),
        regions_(grid_),
        is_allowed_(regions_.size(), kUnknown),
        prices_(grid_.size(), kClosed),
        steps_(grid_steps(grid_)),
        from_(end_at(start)),
        to_(end_at(goal)) {}

  // Not through empty cubes only: from the end in the smaller region, so that little is looked at in vain.
  std::optional<Points> run() {
    const bool is_wide = share_a_region();
    set_prices(is_wide);
    const bool backwards = !is_wide && cubes_around(to_) < cubes_around(from_);
    if (backwards) std::swap(from_, to_);
    std::optional<Points> points;
    for (int cut = 0; cut < kCuts && !points; ++cut) {
      const std::vector<AStar::Node> way = search();
      if (way.empty()) break;
      points = points_along(way);
    }
    if (points && backwards) std::reverse(points->begin(), points->end());
    return points;
  }

 private:
  struct End {
    Rational3 point;
    AStar::Node own = 0;               // the cube that it is in
    std::vector<AStar::Node> portals;  // empty ones that it sees
  };
  enum : std::int8_t { kUnknown, kNo, kYes };

  [[nodiscard]] End end_at(const Rational3& point) const {
    End end{point, grid_.index(grid_.nearest(to_vector(point))), {}};
    for (const Cube& cube : portals(free_, filter_, point)) end.portals.push_back(grid_.index(cube));
    return end;
  }

  // The number of cubes in the largest of the regions of its portals.
  [[nodiscard]] std::size_t cubes_around(const End& end) {
    std::size_t most = 0;
    for (const AStar::Node portal : end.portals) most = std::max(most, regions_.cubes_around(portal));
    return most;
  }

  // True if there is a way between the ends that leads through empty cubes only.
  [[nodiscard]] bool share_a_region() {
    return std::any_of(from_.portals.begin(), from_.portals.end(), [&](AStar::Node a) {
      return std::any_of(to_.portals.begin(), to_.portals.end(),
                         [&](AStar::Node b) { return regions_.of(a) == regions_.of(b); });
    });
  }

  void set_prices(bool is_wide) {
    for (std::uint32_t i = 0; i < grid_.size(); ++i) {
      if (grid_.is_empty(i)) {
        prices_[i] = kEmpty;
      } else if (!is_wide && !grid_.is_rim(i)) {
        prices_[i] = kEntered;
      }
    }
    if (is_wide) return;
    for (const TightPassage& passage : free_.passages()) make_cheaper(passage.cells);
    for (const TouchingRooms& place : free_.touching_rooms()) make_cheaper(place.cells);
  }

  void make_cheaper(const std::vector<CellId>& cells) {
    for (const CellId cell : cells) {
      Vector3d low = Vector3d::Constant(HUGE_VAL);
      Vector3d high = Vector3d::Constant(-HUGE_VAL);
      for (const Rational3& vertex : free_.vertices(cell)) {
        low = low.cwiseMin(to_vector(vertex));
        high = high.cwiseMax(to_vector(vertex));
      }
      for_each_around(grid_, grid_.nearest(low), grid_.nearest(high), 1, [&](const Cube& cube) {
        Price& price = prices_[grid_.index(cube)];
        if (price == kEntered) price = kPassage;
      });
    }
  }

  // True if the region of an empty cube is in a volume that may be used.
  bool is_allowed(AStar::Node cube) {
    std::int8_t& known = is_allowed_[regions_.of(cube)];
    if (known == kUnknown) {
      known = filter_(free_.locate(ExactPoint(exact_centre(grid_, grid_.cube(cube))))) ? kYes : kNo;
    }
    return known == kYes;
  }

  // The cubes of a way; none if there is none.
  std::vector<AStar::Node> search() {
    AStar search(grid_.size());
    for (AStar::Node node = 0; node < grid_.size(); ++node) {
      if (prices_[node] == kClosed) search.close(node);
    }
    const Cube goal = grid_.cube(to_.own);
    const auto offer = [&](const Cube& cube, AStar::Node node, AStar::Node before, double cost) {
      search.offer(node, before, cost, cost + kHaste * steps_between(cube, goal));
    };
    const std::vector<AStar::Node> ends = to_.portals.empty() ? std::vector<AStar::Node>{to_.own} : to_.portals;
    for (const AStar::Node portal : from_.portals) {
      const Cube cube = grid_.cube(portal);
      offer(cube, portal, AStar::kNone, (grid_.centre(cube) - to_vector(from_.point)).norm() / grid_.side());
    }
    if (from_.portals.empty()) offer(grid_.cube(from_.own), from_.own, AStar::kNone, 0);
    while (const std::optional<AStar::Node> node = search.next()) {
      monitor_.check_interruption();
      if (std::find(ends.begin(), ends.end(), *node) != ends.end()) return search.way_to(*node);
      const Cube at = grid_.cube(*node);
      const bool was_empty = grid_.is_empty(*node);
      for (const GridStep& step : steps_) {
        const AStar::Node next = *node + step.offset;
        const double cost = search.cost(*node) + prices_[next] * step.length;
        if (!search.improves(next, cost)) continue;
        if (was_empty || !grid_.is_empty(next) || is_allowed(next)) offer(step.from(at), next, *node, cost);
      }
    }
    return {};
  }

  // The points of a way over these cubes. If there is none through entered cubes in a row, these are closed.
  std::optional<Points> points_along(const std::vector<AStar::Node>& way) {
    Points points{from_.point};
    for (std::size_t i = 0; i < way.size();) {
      if (grid_.is_empty(way[i])) {
        if (is_bend(way, i)) points.push_back(exact_centre(grid_, grid_.cube(way[i])));
        ++i;
        continue;
      }
      std::size_t next = i;
      while (next < way.size() && !grid_.is_empty(way[next])) ++next;
      const std::span<const AStar::Node> entered{way.data() + i, next - i};
      const Rational3 beyond = next < way.size() ? exact_centre(grid_, grid_.cube(way[next])) : to_.point;
      const std::optional<Points> through = way_through(entered, points.back(), beyond);
      if (!through) {
        for (const AStar::Node cube : entered) prices_[cube] = kClosed;
        return std::nullopt;
      }
      points.insert(points.end(), through->begin() + 1, through->end());
      i = std::max(next, i + 1);
    }
    if (points.back() != to_.point) points.push_back(to_.point);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  // True unless the way leads straight on through empty cubes.
  [[nodiscard]] bool is_bend(const std::vector<AStar::Node>& way, std::size_t i) const {
    return i == 0 || i + 1 == way.size() || !grid_.is_empty(way[i - 1]) || !grid_.is_empty(way[i + 1]) ||
           way[i] - way[i - 1] != way[i + 1] - way[i];
  }

  // A way between two points next to some cubes, through what is free around these.
  [[nodiscard]] std::optional<Points> way_through(std::span<const AStar::Node> cubes, const Rational3& a,
                                                  const Rational3& b) const {
    const std::array<Rational3, 2> box = box_around(cubes, a, b);
    const FreeSpace part(intersect(free_.set(), make_box(box[0], box[1], monitor_), 1, monitor_));
    if (part.cells().size() > std::max(kSmallPart, free_.cells().size() / 8)) return std::nullopt;
    CellFilter filter(part);
    for (CellId cell = 0; cell < part.cells().size(); ++cell) {
      if (part.is_free(cell) && part.local_dimension(cell) < min_dimension_) filter.forbid(cell);
    }
    const CellId from = part.locate(ExactPoint(a));
    const CellId to = part.locate(ExactPoint(b));
    if (!filter(from) || !filter(to) || part.component(from) != part.component(to)) return std::nullopt;
    std::optional<Points> points = roadmap_path(part, filter, a, b, false, monitor_);
    for (std::size_t i = 0; points && i + 1 < points->size(); ++i) {
      if (!segment_allowed(free_, filter_, (*points)[i], (*points)[i + 1])) return std::nullopt;
    }
    return points;
  }

  [[nodiscard]] std::array<Rational3, 2> box_around(std::span<const AStar::Node> cubes, const Rational3& a,
                                                    const Rational3& b) const {
    std::array<Rational3, 2> box{a, a};
    const auto add = [&](const Rational3& x) {
      for (std::size_t k = 0; k < 3; ++k) {
        box[0][k] = std::min(box[0][k], x[k]);
        box[1][k] = std::max(box[1][k], x[k]);
      }
    };
    add(b);
    for (const AStar::Node cube : cubes) add(exact_centre(grid_, grid_.cube(cube)));
    const Rational margin = exact_rational(grid_.side()) * (2 * kMargin + 1) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] -= margin;
      box[1][k] += margin;
    }
    return box;
  }

  const FreeSpace& free_;
  const CellFilter& filter_;
  int min_dimension_;
  Monitor monitor_;
  const EmptyGrid& grid_;
  EmptyRegions regions_;
  std::vector<std::int8_t> is_allowed_;  // of each region
  std::vector<Price> prices_;            // of each cube
  std::vector<GridStep> steps_;
  End from_;
  End to_;
};

}  // namespace

std::optional<std::vector<Rational3>> corridor_path(const FreeSpace& free, const CellFilter& filter, int min_dimension,
                                                    const Rational3& start, const Rational3& goal,
                                                    const Monitor& monitor) {
  if (segment_allowed(free, filter, start, goal)) return Points{start, goal};
  if (free.grid(monitor).size() == 0) return std::nullopt;
  return CorridorSearch(free, filter, min_dimension, start, goal, monitor).run();
}

}  // namespace nef::planner
