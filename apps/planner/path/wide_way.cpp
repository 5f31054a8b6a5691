// SPDX-License-Identifier: Apache-2.0
//
// A* over the cubes that no boundary enters.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/planner/path/a_star.h"
#include "apps/planner/path/path.h"
#include "nef/base/interruption.h"

namespace nef::planner {
namespace {

using Cube = EmptyGrid::Cube;

constexpr int kReach = 3;            // cubes around an end that are tried
constexpr std::size_t kPortals = 4;  // and how many of them are taken
constexpr double kHaste = 1.02;      // the estimates are exact in empty country: a hair more breaks ties forward

Rational3 exact(const Vector3d& x) { return {exact_rational(x[0]), exact_rational(x[1]), exact_rational(x[2])}; }

// The length of the shortest way in steps to the 26 neighbours.
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

class WideWay {
 public:
  WideWay(const FreeSpace& free, const CellFilter& filter, const Rational3& start, const Rational3& goal)
      : free_(free), filter_(filter), grid_(free.grid()), start_(start), goal_(goal), search_(grid_.size()) {
    for_each_around({1, 1, 1}, 1, [&](const Cube& next) {
      const Cube middle{1, 1, 1};
      if (next == middle) return;
      Step step{grid_.index(next) - grid_.index(middle), {}, steps_between(middle, next)};
      for (std::size_t i = 0; i < 3; ++i) step.by[i] = next[i] - middle[i];
      steps_.push_back(step);
    });
  }

  std::optional<std::vector<Rational3>> run() {
    const std::vector<Cube> from = portals(start_);
    const std::vector<Cube> to = portals(goal_);
    if (from.empty() || to.empty()) return std::nullopt;
    goal_cube_ = grid_.nearest(to_vector(goal_));
    for (AStar::Node node = 0; node < grid_.size(); ++node) {
      if (!grid_.is_empty(node)) search_.close(node);
    }
    std::vector<AStar::Node> ends;
    for (const Cube& cube : to) ends.push_back(grid_.index(cube));
    for (const Cube& cube : from) {
      const double cost = (grid_.centre(cube) - to_vector(start_)).norm() / grid_.side();
      offer(cube, grid_.index(cube), AStar::kNone, cost);
    }
    while (const std::optional<AStar::Node> node = search_.next()) {
      check_interruption();
      if (std::find(ends.begin(), ends.end(), *node) != ends.end()) return extract(search_.way_to(*node));
      expand(*node);
    }
    return std::nullopt;
  }

 private:
  // To one of the 26 neighbours; differences are modulo 2^32.
  struct Step {
    AStar::Node offset = 0;
    Cube by{};
    double length = 0;
  };

  // Empty cubes near an end whose centres it sees, nearest first.
  [[nodiscard]] std::vector<Cube> portals(const Rational3& end) const {
    const Vector3d place = to_vector(end);
    const Cube own = grid_.nearest(place);
    std::vector<std::pair<double, Cube>> near;
    for_each_around(own, kReach, [&](const Cube& cube) {
      if (grid_.is_empty(grid_.index(cube))) near.emplace_back((grid_.centre(cube) - place).norm(), cube);
    });
    std::sort(near.begin(), near.end());
    std::vector<Cube> result;
    for (const auto& [distance, cube] : near) {
      if (result.size() == kPortals) break;
      if (segment_allowed(free_, filter_, end, exact(grid_.centre(cube)))) result.push_back(cube);
    }
    return result;
  }

  template <typename Visit>
  void for_each_around(const Cube& cube, int reach, const Visit& visit) const {
    std::array<std::array<std::int64_t, 2>, 3> range{};
    for (std::size_t i = 0; i < 3; ++i) {
      range[i] = {std::max<std::int64_t>(0, std::int64_t{cube[i]} - reach),
                  std::min<std::int64_t>(grid_.counts()[i] - 1, std::int64_t{cube[i]} + reach)};
    }
    for (auto z = range[2][0]; z <= range[2][1]; ++z) {
      for (auto y = range[1][0]; y <= range[1][1]; ++y) {
        for (auto x = range[0][0]; x <= range[0][1]; ++x) {
          visit(Cube{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)});
        }
      }
    }
  }

  void expand(AStar::Node node) {
    const double cost = search_.cost(node);
    const Cube at = grid_.cube(node);
    for (const Step& step : steps_) {
      const AStar::Node next = node + step.offset;
      if (!search_.improves(next, cost + step.length)) continue;
      offer({at[0] + step.by[0], at[1] + step.by[1], at[2] + step.by[2]}, next, node, cost + step.length);
    }
  }

  // A way to the cube of this number that improves.
  void offer(const Cube& cube, AStar::Node node, AStar::Node from, double cost) {
    search_.offer(node, from, cost, cost + kHaste * steps_between(cube, goal_cube_));
  }

  // The way's points where it turns.
  [[nodiscard]] std::vector<Rational3> extract(const std::vector<AStar::Node>& way) const {
    std::vector<Rational3> points{start_};
    for (std::size_t i = 0; i < way.size(); ++i) {
      if (i > 0 && i + 1 < way.size()) {
        const Vector3d before = grid_.centre(grid_.cube(way[i])) - grid_.centre(grid_.cube(way[i - 1]));
        const Vector3d after = grid_.centre(grid_.cube(way[i + 1])) - grid_.centre(grid_.cube(way[i]));
        if (before == after) continue;
      }
      const Rational3 point = exact(grid_.centre(grid_.cube(way[i])));
      if (point != points.back()) points.push_back(point);
    }
    if (points.back() != goal_) points.push_back(goal_);
    return points;
  }

  const FreeSpace& free_;
  const CellFilter& filter_;
  const EmptyGrid& grid_;
  const Rational3& start_;
  const Rational3& goal_;
  Cube goal_cube_{};
  AStar search_;
  std::vector<Step> steps_;
};

}  // namespace

std::optional<std::vector<Rational3>> wide_way(const FreeSpace& free, const CellFilter& filter, const Rational3& start,
                                               const Rational3& goal) {
  if (segment_allowed(free, filter, start, goal)) return std::vector<Rational3>{start, goal};
  if (free.grid().size() == 0) return std::nullopt;
  return WideWay(free, filter, start, goal).run();
}

}  // namespace nef::planner
