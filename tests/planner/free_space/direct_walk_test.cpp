// SPDX-License-Identifier: Apache-2.0
//
// Segments without the partition of space, against those with it.
#include "apps/planner/free_space/direct_walk.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/segments.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

TEST_CASE("a segment's cells are the same with and without the partition of space, and so says point location") {
  for (unsigned seed = 0; seed < nef::test::fewer(30); ++seed) {
    INFO("seed " << seed);
    const FreeSpace direct(degenerate_set(seed));
    const FreeSpace by_tree(direct.set());
    by_tree.build_roadmap();
    const CellFilter filter(direct);
    std::mt19937 random(seed + 1000);
    for (int i = 0; i < 60; ++i) {
      const Rational3 a = point_near_degenerate_set(random, 1 + i % 3);
      const Rational3 b = point_near_degenerate_set(random, 1);
      const std::vector<CellOnSegment> mine = cells_along(direct, a, b);
      const std::vector<CellOnSegment> other = cells_along(by_tree, a, b);
      REQUIRE_FALSE(direct.has_roadmap());
      REQUIRE(mine.size() == other.size());
      for (std::size_t k = 0; k < mine.size(); ++k) {
        CHECK(mine[k].cell == other[k].cell);
        CHECK(mine[k].is_point == other[k].is_point);
      }
      CHECK(segment_allowed(direct, filter, a, b) == segment_allowed(by_tree, filter, a, b));
      // The truth about one segment in a few, from a Boolean of the core.
      const bool inside = i % 8 != 0 || a == b || subtract(make_segment(a, b), direct.set()).is_empty();
      if (i % 8 == 0 && a != b) CHECK(segment_allowed(direct, filter, a, b) == inside);
      const std::optional<Rational3> blocked = first_blocked_position(direct, a, b);
      CHECK(blocked.has_value() != segment_allowed(direct, filter, a, b));
      if (blocked) CHECK_FALSE(contains(direct.set(), *blocked));
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
