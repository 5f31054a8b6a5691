// SPDX-License-Identifier: Apache-2.0
//
// What searches over the cubes of a grid share.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "apps/planner/free_space/segments.h"
#include "apps/planner/search/a_star.h"
#include "nef/base/union_find.h"

namespace nef::planner {

/// To one of the 26 neighbours of a cube; differences are modulo 2^32.
struct GridStep {
  AStar::Node offset = 0;
  EmptyGrid::Cube by{};
  double length = 0;  ///< in sides

  [[nodiscard]] EmptyGrid::Cube from(const EmptyGrid::Cube& at) const {
    return {at[0] + by[0], at[1] + by[1], at[2] + by[2]};
  }
};
std::vector<GridStep> grid_steps(const EmptyGrid& grid);

/// The length of the shortest way in steps to the 26 neighbours, in sides.
double steps_between(const EmptyGrid::Cube& a, const EmptyGrid::Cube& b);

Rational3 exact_centre(const EmptyGrid& grid, const EmptyGrid::Cube& cube);

/// Some empty cubes near a point whose centres it sees, nearest first.
std::vector<EmptyGrid::Cube> portals(const FreeSpace& free, const CellFilter& filter, const Rational3& point);

/// The empty cubes by regions: those joined by steps to the six neighbours that share a face. O(cubes) to make.
class EmptyRegions {
 public:
  explicit EmptyRegions(const EmptyGrid& grid);

  /// The region of an empty cube, a number below size(). O(log runs).
  [[nodiscard]] std::uint32_t of(std::uint32_t cube);
  [[nodiscard]] std::size_t size() const { return runs_.size(); }
  /// How many cubes the region of an empty cube has. O(runs).
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

/// Calls visit(cube) for the cubes from one to another in each coordinate, and all that are at most so many steps from
/// them.
template <typename Visit>
void for_each_around(const EmptyGrid& grid, const EmptyGrid::Cube& low, const EmptyGrid::Cube& high, int reach,
                     const Visit& visit) {
  std::array<std::array<std::int64_t, 2>, 3> range{};
  for (std::size_t i = 0; i < 3; ++i) {
    range[i] = {std::max<std::int64_t>(0, std::int64_t{low[i]} - reach),
                std::min<std::int64_t>(grid.counts()[i] - 1, std::int64_t{high[i]} + reach)};
  }
  for (auto z = range[2][0]; z <= range[2][1]; ++z) {
    for (auto y = range[1][0]; y <= range[1][1]; ++y) {
      for (auto x = range[0][0]; x <= range[0][1]; ++x) {
        visit(EmptyGrid::Cube{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                              static_cast<std::uint32_t>(z)});
      }
    }
  }
}

}  // namespace nef::planner
