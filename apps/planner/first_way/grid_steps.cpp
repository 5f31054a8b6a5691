// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/first_way/grid_steps.h"

#include <cmath>
#include <utility>

namespace nef::planner {
namespace {

using Cube = EmptyGrid::Cube;

constexpr int kReach = 3;            // cubes around an end that are tried
constexpr std::size_t kPortals = 4;  // and how many of them are taken

}  // namespace

std::vector<GridStep> grid_steps(const EmptyGrid& grid) {
  const Cube middle{1, 1, 1};
  std::vector<GridStep> result;
  for_each_around(grid, middle, 1, [&](const Cube& next) {
    if (next == middle) return;
    GridStep step{grid.index(next) - grid.index(middle), {}, steps_between(middle, next)};
    for (std::size_t i = 0; i < 3; ++i) step.by[i] = next[i] - middle[i];
    result.push_back(step);
  });
  return result;
}

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

Rational3 exact_centre(const EmptyGrid& grid, const Cube& cube) {
  const Vector3d x = grid.centre(cube);
  return {exact_rational(x[0]), exact_rational(x[1]), exact_rational(x[2])};
}

std::vector<Cube> portals(const FreeSpace& free, const CellFilter& filter, const Rational3& point) {
  const EmptyGrid& grid = free.grid();
  const Vector3d place = to_vector(point);
  std::vector<std::pair<double, Cube>> near;
  for_each_around(grid, grid.nearest(place), kReach, [&](const Cube& cube) {
    if (grid.is_empty(grid.index(cube))) near.emplace_back((grid.centre(cube) - place).norm(), cube);
  });
  std::sort(near.begin(), near.end());
  std::vector<Cube> result;
  for (const auto& [distance, cube] : near) {
    if (result.size() == kPortals) break;
    if (segment_allowed(free, filter, point, exact_centre(grid, cube))) result.push_back(cube);
  }
  return result;
}

}  // namespace nef::planner
