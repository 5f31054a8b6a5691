// SPDX-License-Identifier: Apache-2.0
//
// A* over the cubes that no boundary enters.
#include <algorithm>

#include "apps/planner/first_way/first_way.h"
#include "apps/planner/first_way/grid_steps.h"

namespace nef::planner {
namespace {

using Cube = EmptyGrid::Cube;

constexpr double kHaste = 1.02;  // the estimates are exact in empty country: a hair more breaks ties forward

class WideWay {
 public:
  WideWay(const FreeSpace& free, const CellFilter& filter, const Rational3& start, const Rational3& goal,
          const Monitor& monitor)
      : free_(free),
        filter_(filter),
        monitor_(monitor),
        grid_(free.grid(monitor)),
        start_(start),
        goal_(goal),
        search_(grid_.size()),
        steps_(grid_steps(grid_)) {}

  std::optional<std::vector<Rational3>> run() {
    const std::vector<Cube> from = portals(free_, filter_, start_);
    const std::vector<Cube> to = portals(free_, filter_, goal_);
    if (from.empty() || to.empty() || goal_is_shut_in(from, to)) return std::nullopt;
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
      monitor_.check_interruption();
      if (std::find(ends.begin(), ends.end(), *node) != ends.end()) return extract(search_.way_to(*node));
      expand(*node);
    }
    return std::nullopt;
  }

 private:
  // True if the empty cubes around the goal's portals are few and do not reach the start's: so that not all of the
  // start's are looked at for nothing.
  [[nodiscard]] bool goal_is_shut_in(const std::vector<Cube>& from, const std::vector<Cube>& to) const {
    constexpr std::size_t kFew = 4096;
    std::vector<bool> seen(grid_.size(), false);
    std::vector<AStar::Node> reached;
    const auto reach = [&](AStar::Node node) {
      if (seen[node] || !grid_.is_empty(node)) return;
      seen[node] = true;
      reached.push_back(node);
    };
    for (const Cube& cube : to) reach(grid_.index(cube));
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached.size() > kFew) return false;
      const AStar::Node node = reached[i];
      for (const GridStep& step : steps_) reach(node + step.offset);
    }
    return std::none_of(from.begin(), from.end(), [&](const Cube& cube) { return seen[grid_.index(cube)]; });
  }

  void expand(AStar::Node node) {
    const double cost = search_.cost(node);
    const Cube at = grid_.cube(node);
    for (const GridStep& step : steps_) {
      const AStar::Node next = node + step.offset;
      if (!search_.improves(next, cost + step.length)) continue;
      offer(step.from(at), next, node, cost + step.length);
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
      const Rational3 point = exact_centre(grid_, grid_.cube(way[i]));
      if (point != points.back()) points.push_back(point);
    }
    if (points.back() != goal_) points.push_back(goal_);
    return points;
  }

  const FreeSpace& free_;
  const CellFilter& filter_;
  Monitor monitor_;
  const EmptyGrid& grid_;
  const Rational3& start_;
  const Rational3& goal_;
  Cube goal_cube_{};
  AStar search_;
  std::vector<GridStep> steps_;
};

}  // namespace

std::optional<std::vector<Rational3>> wide_way(const FreeSpace& free, const CellFilter& filter, const Rational3& start,
                                               const Rational3& goal, const Monitor& monitor) {
  if (segment_allowed(free, filter, start, goal)) return std::vector<Rational3>{start, goal};
  if (free.grid(monitor).size() == 0) return std::nullopt;
  return WideWay(free, filter, start, goal, monitor).run();
}

}  // namespace nef::planner
