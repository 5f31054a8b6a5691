// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/empty_grid.h"

#include <catch2/catch.hpp>
#include <random>

#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

TEST_CASE("cubes of the grid that count as empty hold nothing of the boundary") {
  for (unsigned seed = 0; seed < nef::test::fewer(12); ++seed) {
    INFO("seed " << seed);
    const Polyhedron set = degenerate_set(seed);
    const EmptyGrid grid(set.complex(), {});
    REQUIRE(grid.size() > 0);
    const Polyhedron surface = boundary(set);
    const Rational half = exact_rational(grid.side()) / 2;
    std::mt19937 random(seed);
    std::size_t empty = 0;
    for (int i = 0; i < 60; ++i) {
      const auto index = static_cast<std::uint32_t>(random() % grid.size());
      if (!grid.is_empty(index)) continue;
      ++empty;
      const Vector3d centre = grid.centre(grid.cube(index));
      Rational3 low;
      Rational3 high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = exact_rational(centre[static_cast<Eigen::Index>(k)]) - half;
        high[k] = exact_rational(centre[static_cast<Eigen::Index>(k)]) + half;
      }
      CHECK(intersect(make_box(low, high), surface).is_empty());
    }
    CHECK(empty > 5);
  }
}

TEST_CASE("there is no grid where there is nothing, or where doubles cannot hold it") {
  CHECK(EmptyGrid(Polyhedron().complex(), {}).size() == 0);
  CHECK(EmptyGrid(make_point({1, 2, 3}).complex(), {}).size() == 0);
  const Rational far(Integer("1000000000000000000000000000000"));
  CHECK(EmptyGrid(make_box({far, 0, 0}, {far + 1, 1, 1}).complex(), {}).size() == 0);
}

}  // namespace
}  // namespace nef::planner::test
