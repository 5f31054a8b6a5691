// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/search/grid_steps.h"

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
  for_each_around(grid, middle, middle, 1, [&](const Cube& next) {
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

std::vector<Cube> portals(const FreeSpace& free, const CellFilter& filter, const Rational3& point) {
  const EmptyGrid& grid = free.grid();
  const Vector3d place = to_vector(point);
  std::vector<std::pair<double, Cube>> near;
  const Cube own = grid.nearest(place);
  for_each_around(grid, own, own, kReach, [&](const Cube& cube) {
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
