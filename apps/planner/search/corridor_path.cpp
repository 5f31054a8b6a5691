// SPDX-License-Identifier: Apache-2.0
//
// A* over cubes of which those that the boundary enters are dear, in the way of [Bohlin, Kavraki 2000]: what a way
// through such cubes is worth is found out when one is wanted. There free space is cut out, and its roadmap tells. The
// empty cubes are grouped into regions, so that whether a way through them alone exists is known beforehand.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "apps/planner/free_space/segments.h"
#include "apps/planner/search/a_star.h"
#include "apps/planner/search/search.h"
#include "nef/base/union_find.h"
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
constexpr double kHaste = 1.02;          // the estimates are exact in empty country: a hair more breaks ties forward
constexpr int kCuts = 8;                 // so many are tried in vain
constexpr std::size_t kSmallCut = 1000;  // a roadmap of more cells than so many, or an eighth of all, is not made
constexpr int kReach = 3;                // cubes around an end that are tried
constexpr std::size_t kEntrances = 4;    // and how many of them are taken
constexpr std::uint32_t kMargin = 2;     // cubes around those that a cut is for

// Calls visit(cube) for the cubes from one to another in each coordinate, and all that are at most so many steps from
// them.
template <typename Visit>
void for_each_around(const EmptyGrid& grid, const Cube& low, const Cube& high, int reach, const Visit& visit) {
  std::array<std::array<std::int64_t, 2>, 3> range{};
  for (std::size_t i = 0; i < 3; ++i) {
    range[i] = {std::max<std::int64_t>(0, std::int64_t{low[i]} - reach),
                std::min<std::int64_t>(grid.counts()[i] - 1, std::int64_t{high[i]} + reach)};
  }
  for (auto z = range[2][0]; z <= range[2][1]; ++z) {
    for (auto y = range[1][0]; y <= range[1][1]; ++y) {
      for (auto x = range[0][0]; x <= range[0][1]; ++x) {
        visit(Cube{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)});
      }
    }
  }
}

// To one of the 26 neighbours of a cube; differences are modulo 2^32.
struct GridStep {
  AStar::Node offset = 0;
  Cube by{};
  double length = 0;  // in sides

  [[nodiscard]] Cube from(const Cube& at) const { return {at[0] + by[0], at[1] + by[1], at[2] + by[2]}; }
};

// The length of the shortest way in steps to the 26 neighbours, in sides.
double steps_between(const Cube& a, const Cube& b) {
  const auto apart = [&](std::size_t i) { return std::fabs(static_cast<double>(a[i]) - static_cast<double>(b[i])); };
  const double x = apart(0);
  const double y = apart(1);
  const double z = apart(2);
  const double least = std::min({x, y, z});
  const double most = std::max({x, y, z});
  const double middle = x + y + z - least - most;
  return std::sqrt(3) * least + std::sqrt(2) * (middle - least) + (most - middle);
}

std::vector<GridStep> grid_steps(const EmptyGrid& grid) {
  const Cube middle{1, 1, 1};
  std::vector<GridStep> result;
  for_each_around(grid, middle, middle, 1, [&](const Cube& next) {
    if (next == middle) return;
    GridStep step{grid.index(next) - grid.index(middle), {}, steps_between(middle, next)};
    for (std::size_t i = 0; i < 3; ++i) step.by[i] = next[i] - middle[i];
    result.push_back(step);
  });
  return result;
}

Rational3 exact_centre(const EmptyGrid& grid, const Cube& cube) {
  const Vector3d x = grid.centre(cube);
  return {exact_rational(x[0]), exact_rational(x[1]), exact_rational(x[2])};
}

// The empty cubes by regions: those joined by steps to the six neighbours that share a face. O(cubes) to make.
class EmptyRegions {
 public:
  explicit EmptyRegions(const EmptyGrid& grid);

  // The region of an empty cube, a number below size(). O(log runs).
  [[nodiscard]] std::uint32_t of(std::uint32_t cube);
  [[nodiscard]] std::size_t size() const { return runs_.size(); }
  // How many cubes the region of an empty cube has. O(runs).
  [[nodiscard]] std::size_t cubes_around(std::uint32_t cube);

 private:
  // Empty cubes in a row along the first axis.
  struct Run {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  std::vector<Run> runs_;
  UnionFind same_;  // runs of one region
};

// Runs of neighbouring rows are united where they overlap. Rows at the rim have none.
EmptyRegions::EmptyRegions(const EmptyGrid& grid) {
  const std::uint32_t length = grid.counts()[0];
  const std::uint32_t rows = grid.counts()[1] * grid.counts()[2];
  std::vector<std::size_t> first;  // of each row, and one more
  for (std::uint32_t row = 0; row < rows; ++row) {
    first.push_back(runs_.size());
    const std::uint32_t end = (row + 1) * length;
    for (std::uint32_t cube = row * length; cube < end; ++cube) {
      if (!grid.is_empty(cube)) continue;
      const std::uint32_t begin = cube;
      while (grid.is_empty(cube)) ++cube;  // the last one of a row is not
      runs_.push_back({begin, cube});
    }
  }
  first.push_back(runs_.size());
  same_.reset(runs_.size());
  for (const std::uint32_t step : {1U, grid.counts()[1]}) {
    for (std::uint32_t row = step; row < rows; ++row) {
      std::size_t a = first[row];
      std::size_t b = first[row - step];
      while (a < first[row + 1] && b < first[row - step + 1]) {
        const std::uint32_t begin = runs_[b].begin + step * length;
        const std::uint32_t end = runs_[b].end + step * length;
        if (begin < runs_[a].end && runs_[a].begin < end) {
          same_.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        }
        ++(runs_[a].end < end ? a : b);
      }
    }
  }
}

std::uint32_t EmptyRegions::of(std::uint32_t cube) {
  const auto after =
      std::upper_bound(runs_.begin(), runs_.end(), cube, [](std::uint32_t c, const Run& run) { return c < run.begin; });
  return same_.find(static_cast<std::uint32_t>(after - runs_.begin() - 1));
}

std::size_t EmptyRegions::cubes_around(std::uint32_t cube) {
  const std::uint32_t region = of(cube);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < runs_.size(); ++i) {
    if (same_.find(i) == region) count += runs_[i].end - runs_[i].begin;
  }
  return count;
}

// Some empty cubes near a point whose centres it sees, nearest first.
std::vector<Cube> entrances(const FreeSpace& free, const CellFilter& filter, const Rational3& point) {
  const EmptyGrid& grid = free.grid();
  const Vector3d at = to_vector(point);
  std::vector<std::pair<double, Cube>> near;
  const Cube own = grid.nearest(at);
  for_each_around(grid, own, own, kReach, [&](const Cube& cube) {
    if (grid.is_empty(grid.index(cube))) near.emplace_back((grid.centre(cube) - at).norm(), cube);
  });
  std::sort(near.begin(), near.end());
  std::vector<Cube> result;
  for (const auto& [distance, cube] : near) {
    if (result.size() == kEntrances) break;
    if (segment_allowed(free, filter, point, exact_centre(grid, cube))) result.push_back(cube);
  }
  return result;
}

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
    AStar::Node own = 0;                 // the cube that it is in
    std::vector<AStar::Node> entrances;  // empty ones that it sees
  };
  enum : std::int8_t { kUnknown, kNo, kYes };

  [[nodiscard]] End end_at(const Rational3& point) const {
    End end{point, grid_.index(grid_.nearest(to_vector(point))), {}};
    for (const Cube& cube : entrances(free_, filter_, point)) end.entrances.push_back(grid_.index(cube));
    return end;
  }

  // The number of cubes in the largest of the regions of its entrances.
  [[nodiscard]] std::size_t cubes_around(const End& end) {
    std::size_t most = 0;
    for (const AStar::Node entrance : end.entrances) most = std::max(most, regions_.cubes_around(entrance));
    return most;
  }

  // True if there is a way between the ends that leads through empty cubes only.
  [[nodiscard]] bool share_a_region() {
    return std::any_of(from_.entrances.begin(), from_.entrances.end(), [&](AStar::Node a) {
      return std::any_of(to_.entrances.begin(), to_.entrances.end(),
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
    for (const TouchingVolumes& touching : free_.touching_volumes()) make_cheaper(touching.cells);
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
    const std::vector<AStar::Node> ends = to_.entrances.empty() ? std::vector<AStar::Node>{to_.own} : to_.entrances;
    for (const AStar::Node entrance : from_.entrances) {
      const Cube cube = grid_.cube(entrance);
      offer(cube, entrance, AStar::kNone, (grid_.centre(cube) - to_vector(from_.point)).norm() / grid_.side());
    }
    if (from_.entrances.empty()) offer(grid_.cube(from_.own), from_.own, AStar::kNone, 0);
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
    const FreeSpace part(intersect(free_.set(), make_box(box[0], box[1], monitor_), monitor_));
    if (part.cells().size() > std::max(kSmallCut, free_.cells().size() / 8)) return std::nullopt;
    const CellFilter filter(part, min_dimension_);
    const CellId from = part.locate(ExactPoint(a));
    const CellId to = part.locate(ExactPoint(b));
    if (!filter(from) || !filter(to) || part.component(from) != part.component(to)) return std::nullopt;
    std::optional<Points> points = roadmap_path(part, filter, a, b, false, monitor_);
    return points && way_allowed(free_, filter_, *points) ? points : std::nullopt;
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
