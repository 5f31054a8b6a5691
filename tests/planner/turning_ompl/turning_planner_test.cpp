// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_planner.h"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>

#include "apps/planner/path/simple_points.h"
#include "apps/planner/turning_ompl/turning_planning.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;

TEST_CASE("our planner for robots that turn, in OMPL: a path, a proof that verifies") {
  TurningPlanning fits(scene_of(corner("3.5")));
  REQUIRE(fits.solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  REQUIRE(fits.getTurningPlanner() != nullptr);
  auto& path = fits.getSolutionPath();
  CHECK(path.getStateCount() == fits.getTurningPlanner()->getAnswer()->path.size());
  CHECK(fits.space().pose(path.getStates().back()).position == Rational3{-1, 12, 0});
  CHECK(fits.space().pose(path.getStates().back()).turn == 1);

  TurningPlanning blocked(scene_of(corner("3.9")));
  CHECK_FALSE(static_cast<bool>(blocked.solve(20.0)));
  REQUIRE(blocked.getProblemDefinition()->hasSolutionNonExistenceProof());
  const auto proof =
      std::dynamic_pointer_cast<TurningImpossibility>(blocked.getProblemDefinition()->getSolutionNonExistenceProof());
  REQUIRE(proof);
  CHECK(proof->verify());
  CHECK_FALSE(proof->proof().cells.empty());

  TurningPlanning limited(scene_of(corner("3.6568")));
  limited.setPlanner(
      std::make_shared<TurningPlanner>(limited.getSpaceInformation(), limited.getScene(), limited.getQuestion()));
  CHECK(limited.getPlanner()->params().setParam("max_cells", "4"));
  CHECK(limited.solve(20.0) == ob::PlannerStatus::TIMEOUT);
}

TEST_CASE("way-points of TurningPlanner with so many digits") {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  TurningPlanning setup(scene_of(corner("3.5")));
  setup.setup();
  REQUIRE(setup.getPlanner()->params().setParam("digits", "2"));
  CHECK_FALSE(setup.getPlanner()->params().setParam("digits", "301"));
  REQUIRE(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(setup.getSolutionPath().check());
  const auto& answer = *setup.getPlanner()->as<TurningPlanner>()->getAnswer();
  std::size_t rounded_count = 0;
  for (std::size_t i = 1; i + 1 < answer.path.size(); ++i) {
    const bool named = std::find(answer.unrounded.begin(), answer.unrounded.end(), i) != answer.unrounded.end();
    CHECK(is_rounded(answer.path[i].position, 2) != named);
    rounded_count += named ? 0 : 1;
  }
  CHECK(rounded_count > 0);
}

}  // namespace
}  // namespace nef::planner::test
