// SPDX-License-Identifier: Apache-2.0
//
// What users of OMPL set themselves counts: bounds of the state space, validity checkers, time, parameters.
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/ompl/translation_planning.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

// A wall with its sides at y = z = -5 and 10, and no bounds: one can walk round it.
void make_wall(TranslationPlanning& setup) {
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(make_box({4, -6, -6}, {5, 12, 12}));
  setup.setExactStartAndGoal({0, 0, 0}, {8, 0, 0});
}

ob::RealVectorBounds cube(double low, double high) {
  ob::RealVectorBounds bounds(3);
  bounds.setLow(low);
  bounds.setHigh(high);
  return bounds;
}

void set_bounds(TranslationPlanning& setup, const ob::RealVectorBounds& bounds) {
  setup.getStateSpace()->as<ob::RealVectorStateSpace>()->setBounds(bounds);
}

TEST_CASE("bounds that the user sets on the state space bound the free space") {
  TranslationPlanning setup;
  make_wall(setup);
  CHECK(setup.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(setup.getTightPlanner()->getExactPath()->points.size() > 2);

  TranslationPlanning bounded;
  make_wall(bounded);
  set_bounds(bounded, cube(-5, 10));
  CHECK_FALSE(bounded.solve(30.0));
  CHECK(bounded.getProblemDefinition()->hasSolutionNonExistenceProof());
  CHECK(bounded.getStateSpace()->as<ob::RealVectorStateSpace>()->getBounds().low[0] == -5);
  // And when they change.
  set_bounds(bounded, cube(-50, 50));
  bounded.clear();
  CHECK(bounded.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_CASE("bounds that the user sets between questions stay, whatever is set after them") {
  const auto low_bound = [](const TranslationPlanning& setup) {
    return setup.getStateSpace()->as<ob::RealVectorStateSpace>()->getBounds().low[0];
  };
  TranslationPlanning setup;
  make_wall(setup);
  CHECK(setup.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
  setup.clear();
  set_bounds(setup, cube(-5, 10));
  setup.setExactStartAndGoal({0, 0, 0}, {8, 0, 0});
  CHECK(low_bound(setup) == -5);
  CHECK_FALSE(setup.solve(30.0));
  CHECK(setup.getProblemDefinition()->hasSolutionNonExistenceProof());
  CHECK(low_bound(setup) == -5);
  // A new question within the same bounds.
  setup.clear();
  setup.setExactStartAndGoal({0, 0, 0}, {8, 1, 0});
  CHECK_FALSE(setup.solve(30.0));
  CHECK(low_bound(setup) == -5);
  // What is said last counts, on whichever way.
  setup.clear();
  setup.setEnvironmentBounds({-50, -50, -50}, {50, 50, 50});
  CHECK(setup.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(low_bound(setup) < -49);
  set_bounds(setup, cube(-50, 50));
  setup.setEnvironmentBounds({-5, -5, -5}, {10, 10, 10});
  CHECK_FALSE(setup.solve(30.0));
  // Without bounds of the user they follow start and goal.
  TranslationPlanning open;
  make_wall(open);
  CHECK(open.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
  open.clear();
  open.setExactStartAndGoal({-100, 0, 0}, {8, 0, 0});
  CHECK(low_bound(open) < -100);
  CHECK(open.solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_CASE("a validity checker of the user's is asked as well") {
  TranslationPlanning setup;
  make_wall(setup);
  int asked = 0;
  // Over the wall is forbidden, and below it.
  const auto level = [&asked](const ob::State* state) {
    ++asked;
    return std::fabs(state->as<StateType>()->values[2]) <= 1;
  };
  setup.setStateValidityChecker(level);
  CHECK(setup.solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(asked > 0);
  CHECK(setup.getSolutionPath().check());
  for (const ob::State* state : setup.getSolutionPath().getStates()) CHECK(level(state));
  // States and motions: the user's opinion and ours.
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  ob::ScopedState<> here(si);
  ob::ScopedState<> above(si);
  ob::ScopedState<> in_the_wall(si);
  here = std::vector<double>{0, 0, 0};
  above = std::vector<double>{0, 0, 2};
  in_the_wall = std::vector<double>{4, 0, 0};
  CHECK(si->isValid(here.get()));
  CHECK_FALSE(si->isValid(above.get()));
  CHECK_FALSE(si->isValid(in_the_wall.get()));
  CHECK_FALSE(si->checkMotion(here.get(), above.get()));
  ob::ScopedState<> last(si);
  std::pair<ob::State*, double> valid(last.get(), 0.0);
  CHECK_FALSE(si->checkMotion(here.get(), above.get(), valid));
  CHECK(valid.second > 0);
  CHECK(valid.second <= 0.5);
  CHECK(si->isValid(last.get()));
}

TEST_CASE("what the user's checker alone forbids is not proved, what the obstacles forbid is, whatever it says") {
  TranslationPlanning setup;
  make_wall(setup);
  setup.setStateValidityChecker(
      [](const ob::State* state) { return std::fabs(state->as<StateType>()->values[0] - 2) > 1; });
  CHECK_FALSE(setup.solve(0.2) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK_FALSE(setup.getProblemDefinition()->hasSolutionNonExistenceProof());

  TranslationPlanning closed;
  make_wall(closed);
  closed.setEnvironmentBounds({-5, -5, -5}, {10, 10, 10});
  closed.setStateValidityChecker([](const ob::State*) { return true; });
  CHECK_FALSE(closed.solve(20.0));
  CHECK(closed.getProblemDefinition()->hasSolutionNonExistenceProof());
}

// Does not like motions in general.
struct NoMotion : ob::MotionValidator {
  using ob::MotionValidator::MotionValidator;
  bool checkMotion(const ob::State*, const ob::State*) const override { return false; }
  bool checkMotion(const ob::State*, const ob::State*, std::pair<ob::State*, double>&) const override { return false; }
};

TEST_CASE("a motion validator of the user's is asked as well") {
  TranslationPlanning setup;
  make_wall(setup);
  setup.getSpaceInformation()->setMotionValidator(std::make_shared<NoMotion>(setup.getSpaceInformation()));
  CHECK_FALSE(setup.solve(0.1) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK_FALSE(setup.getProblemDefinition()->hasSolutionNonExistenceProof());
}

TEST_CASE("solve honours its time while the free space is built, and begins anew the next time") {
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  for (int i = 0; i < 40; ++i) setup.addObstacle(make_box({3 * i, 0, 0}, {3 * i + 1, i, i}));
  setup.setExactStartAndGoal({-5, 0, 0}, {150, 0, 0});
  // However often it is asked before it says stop: the sums, their union, the partition, the roadmap.
  for (const int questions : {1, 3, 10, 30, 100}) {
    int asked = 0;
    const ob::PlannerTerminationCondition soon([&] { return ++asked > questions; });
    CHECK(setup.solve(soon) == ob::PlannerStatus::TIMEOUT);
    CHECK(setup.getFreeSpace() == nullptr);
    CHECK(setup.getLastPlannerStatus() == ob::PlannerStatus::TIMEOUT);
    CHECK_FALSE(setup.haveSolutionPath());
  }
  CHECK(setup.solve(1e-6) == ob::PlannerStatus::TIMEOUT);
  CHECK(setup.solve(ob::plannerNonTerminatingCondition()) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_CASE("solve honours its time inside one sum and one operation") {
  // One convex obstacle: the sum is a single pair of cells, and its complement in the box a single operation.
  std::vector<Rational3> points;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) points.push_back({x, y, 72 - x * x - y * y});
  }
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(convex_hull(points));
  setup.setExactStartAndGoal({-20, 0, 0}, {20, 0, 0});
  for (const int questions : {1, 10, 20}) {
    int asked = 0;
    const ob::PlannerTerminationCondition soon([&] { return ++asked > questions; });
    CHECK(setup.solve(soon) == ob::PlannerStatus::TIMEOUT);
    CHECK(setup.getFreeSpace() == nullptr);
  }
  CHECK(setup.solve(ob::plannerNonTerminatingCondition()) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_CASE("parameters out of range are refused") {
  TranslationPlanning setup;
  TightPlanner planner(setup.getSpaceInformation());
  CHECK(planner.params().setParam("min_dimension", "2"));
  CHECK_FALSE(planner.params().setParam("min_dimension", "7"));
  CHECK_FALSE(planner.params().setParam("min_dimension", "-1"));
  CHECK(planner.getMinDimension() == 2);
  CHECK_THROWS_AS(planner.setMinDimension(4), std::invalid_argument);
}

TEST_CASE("states from arrays of doubles are at these doubles") {
  ExactTranslationSpace space;
  space.setBounds(-1, 1);
  space.setup();
  auto* state = space.allocState()->as<StateType>();
  const Rational3 third{Rational(1, 3), 0, 0};
  state->setExact(third);
  std::vector<double> reals(3);
  space.copyToReals(reals, state);
  CHECK(reals == std::vector<double>{1.0 / 3, 0, 0});
  CHECK(state->exact() == third);
  // The same doubles again, but given as doubles.
  space.copyFromReals(state, reals);
  CHECK_FALSE(state->hasExact());
  CHECK(state->exact() == Rational3{exact_rational(1.0 / 3), 0, 0});
  space.freeState(state);
}

}  // namespace
}  // namespace nef::planner::test
