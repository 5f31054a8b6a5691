// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/cell_sampler.h"

#include <catch2/catch.hpp>

#include "apps/planner/ompl/translation_planning.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

TEST_CASE("TightPlanner needs no roadmap for OMPL's own setup, nor to draw from facets of any shape") {
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(make_box({0, 0, -1}, {9, 9, 0}));
  // The passage between the two is shaped like an L.
  setup.addObstacle(unite(make_box({0, 0, 1}, {9, 3, 2}), make_box({0, 0, 1}, {3, 9, 2})));
  setup.setExactStartAndGoal({-5, -5, 0}, {20, 20, 0});
  setup.setup();
  const std::shared_ptr<const FreeSpace> free = setup.getFreeSpace();
  CHECK_FALSE(free->has_roadmap());
  CHECK(setup.getStateSpace()->getDefaultProjection()->getDimension() == 3);
  const CellPool pool(free);
  ompl::RNG random(7);
  int concave = 0;
  for (int i = 0; i < 400; ++i) {
    const CellId cell = free->locate(ExactPoint(pool.draw(random)));
    REQUIRE(free->is_free(cell));
    if (free->cells().dimension(cell) == 2 && free->vertices(cell).size() == 6) ++concave;
  }
  CHECK(concave > 5);
  CHECK_FALSE(free->has_roadmap());
}

}  // namespace
}  // namespace nef::planner::test
