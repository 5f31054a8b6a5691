// SPDX-License-Identifier: Apache-2.0
#include "tests/planner/grid_arrangement.h"

#include <catch2/catch.hpp>

namespace nef::planner::test {

std::vector<Cell> compare_all(const FreeSpace& free, const Arrangement& truth, const std::vector<int>& component,
                              int count) {
  CHECK(free.components().size() == static_cast<std::size_t>(count));
  std::vector<int> number_of(static_cast<std::size_t>(count), -1);
  std::vector<Cell> special;
  int wrong = 0;
  const int outer = component[Arrangement::index({-9, -9, -9})];
  for (int x = -9; x <= 15; ++x) {
    for (int y = -9; y <= 15; ++y) {
      for (int z = -9; z <= 15; ++z) {
        const Cell c{x, y, z};
        const CellId cell = free.locate(ExactPoint(std::array<double, 3>{x / 2.0, y / 2.0, z / 2.0}));
        if (free.is_free(cell) != truth.is_free(c)) ++wrong;
        if (!free.is_free(cell) || !truth.is_free(c)) continue;
        if (free.local_dimension(cell) != truth.local_dimension(c)) ++wrong;
        if (free.cells().dimension(cell) != truth.freedom(c)) ++wrong;
        int& number = number_of[static_cast<std::size_t>(component[Arrangement::index(c)])];
        if (number < 0) number = static_cast<int>(free.component(cell));
        if (number != static_cast<int>(free.component(cell))) ++wrong;
        if (truth.local_dimension(c) < 3 || component[Arrangement::index(c)] != outer) special.push_back(c);
      }
    }
  }
  CHECK(wrong == 0);
  std::sort(number_of.begin(), number_of.end());
  CHECK(std::adjacent_find(number_of.begin(), number_of.end()) == number_of.end());
  return special;
}

}  // namespace nef::planner::test
