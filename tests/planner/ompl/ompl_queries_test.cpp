// SPDX-License-Identifier: Apache-2.0
//
// Questions as OMPL code asks them: goals that come one by one or never end, problems exchanged, obstacles added
// after a solution, states from anywhere.
#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalStates.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <thread>

#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/ompl/translation_planning.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

ob::ScopedState<> at(const ob::SpaceInformationPtr& si, double x, double y, double z) {
  ob::ScopedState<> state(si);
  state = std::vector<double>{x, y, z};
  return state;
}

// A question of the planner alone.
ob::PlannerStatus ask(TightPlanner& planner, const ob::GoalPtr& goal, const ob::PlannerTerminationCondition& ptc,
                      ob::ProblemDefinitionPtr* asked = nullptr) {
  auto definition = std::make_shared<ob::ProblemDefinition>(goal->getSpaceInformation());
  definition->addStartState(at(goal->getSpaceInformation(), 1, 1, 1));
  definition->setGoal(goal);
  if (asked != nullptr) *asked = definition;
  planner.setProblemDefinition(definition);
  return planner.solve(ptc);
}

// A goal that can be sampled for ever: 200 times one point, then another.
struct EndlessGoal : ob::GoalSampleableRegion {
  using Point = std::array<double, 3>;
  EndlessGoal(const ob::SpaceInformationPtr& si, const Point& first, const Point& then)
      : ob::GoalSampleableRegion(si), first_(first), then_(then) {}
  double distanceGoal(const ob::State* /*state*/) const override { return 0; }
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }
  void sampleGoal(ob::State* state) const override {
    const Point& point = drawn_++ < 200 ? first_ : then_;
    std::copy(point.begin(), point.end(), state->as<StateType>()->values);
  }
  Point first_;
  Point then_;
  mutable int drawn_ = 0;
};

struct PlannedWorld {
  PlannedWorld() : problem(load("s1_tight_hole")), setup(problem), si(setup.getSpaceInformation()), planner(si) {
    setup.setup();
    planner.setup();
  }
  Problem problem;
  TranslationPlanning setup;
  ob::SpaceInformationPtr si;
  TightPlanner planner;
};

TEST_CASE("goals out of reach and invalid ones are answered without waiting for the time to end") {
  PlannedWorld world;
  const ob::PlannerTerminationCondition never = ob::plannerNonTerminatingCondition();
  auto goals = std::make_shared<ob::GoalStates>(world.si);
  goals->addState(at(world.si, 4, 0, 0));
  CHECK(ask(world.planner, goals, never) == ob::PlannerStatus::INVALID_GOAL);
  goals->addState(at(world.si, -2, 0, 0));
  ob::ProblemDefinitionPtr definition;
  CHECK_FALSE(ask(world.planner, goals, never, &definition));
  CHECK(definition->hasSolutionNonExistenceProof());
  goals->addState(at(world.si, 7, 1, 1));
  CHECK(ask(world.planner, goals, never) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(ask(world.planner, goals, ob::plannerAlwaysTerminatingCondition()) == ob::PlannerStatus::TIMEOUT);
}

TEST_CASE("a goal region without end: the search goes on until the time is over, and nothing is proved") {
  PlannedWorld world;
  const EndlessGoal::Point outside{-2, 0, 0};
  const EndlessGoal::Point in_the_wall{4, 0, 0};
  const EndlessGoal::Point in_reach{7, 1, 1};
  for (const EndlessGoal::Point& first : {outside, in_the_wall}) {
    const auto goal = std::make_shared<EndlessGoal>(world.si, first, in_reach);
    CHECK(ask(world.planner, goal, ob::timedPlannerTerminationCondition(5.0)) == ob::PlannerStatus::EXACT_SOLUTION);
  }
  ob::ProblemDefinitionPtr definition;
  for (const EndlessGoal::Point& always : {outside, in_the_wall}) {
    const auto goal = std::make_shared<EndlessGoal>(world.si, always, always);
    CHECK(ask(world.planner, goal, ob::timedPlannerTerminationCondition(0.05), &definition) ==
          ob::PlannerStatus::TIMEOUT);
    CHECK_FALSE(definition->hasSolutionNonExistenceProof());
  }
}

TEST_CASE("goals that a thread finds later are waited for") {
  PlannedWorld world;
  int drawn = 0;
  const auto sampler = [&](const ob::GoalLazySamples* /*goal*/, ob::State* state) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    world.si->copyState(state, at(world.si, drawn == 0 ? -2 : 7, 1, 1).get());
    return ++drawn < 3;  // the last one does not count
  };
  auto goal = std::make_shared<ob::GoalLazySamples>(world.si, sampler);
  CHECK(ask(world.planner, goal, ob::timedPlannerTerminationCondition(5.0)) == ob::PlannerStatus::EXACT_SOLUTION);
  goal->stopSampling();
}

TEST_CASE("another problem for the same planner forgets the states of the first") {
  PlannedWorld world;
  const auto goal_at = [&](double x) {
    auto goals = std::make_shared<ob::GoalStates>(world.si);
    goals->addState(at(world.si, x, 1, 1));
    return goals;
  };
  const auto never = ob::plannerNonTerminatingCondition();
  CHECK(ask(world.planner, goal_at(7), never) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK_FALSE(ask(world.planner, goal_at(-2), never));
  CHECK(ask(world.planner, goal_at(6), never) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(world.planner.getExactPath()->points.back()[0] == 6);
}

TEST_CASE("robot, obstacles and contact may change after a solution") {
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(make_box({3, 0, 0}, {4, 1, 1}));
  setup.setExactStartAndGoal({0, 0, 0}, {6, 0, 0});
  REQUIRE(setup.solve(1.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const double before = setup.getSolutionPath().length();
  setup.addObstacle(make_box({3, -5, -5}, {4, 5, 5}));
  for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
    setup.setContact(contact);
    setup.clear();
    REQUIRE(setup.solve(1.0) == ob::PlannerStatus::EXACT_SOLUTION);
    CHECK(setup.getSolutionPath().check());
    CHECK(setup.getSolutionPath().length() > before + 3);
  }
  setup.addObstacle(subtract(make_box({-2, -2, -2}, {3, 3, 3}), interior(make_box({-1, -1, -1}, {2, 2, 2}))));
  setup.clear();
  CHECK_FALSE(setup.solve(1.0));
  CHECK(setup.getProblemDefinition()->hasSolutionNonExistenceProof());
}

TEST_CASE("start and goal may lie far out, also after the first solution") {
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(make_box({3, 0, 0}, {4, 1, 1}));
  setup.setExactStartAndGoal({0, 0, 0}, {6, 0, 0});
  REQUIRE(setup.solve(1.0) == ob::PlannerStatus::EXACT_SOLUTION);
  setup.clear();
  setup.setStartAndGoalStates(at(setup.getSpaceInformation(), -1000, 0, 0), at(setup.getSpaceInformation(), 0, 0, 700));
  CHECK(setup.solve(1.0) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_CASE("planner data: start and goal are marked, every edge is a free motion") {
  PlannedWorld world;
  auto goals = std::make_shared<ob::GoalStates>(world.si);
  goals->addState(at(world.si, 7, 1, 1));
  REQUIRE(ask(world.planner, goals, ob::plannerNonTerminatingCondition()));
  ob::PlannerData data(world.si);
  world.planner.getPlannerData(data);
  CHECK(data.numStartVertices() == 1);
  CHECK(data.numGoalVertices() == 1);
  std::vector<unsigned int> next;
  int blocked = 0;
  for (unsigned int v = 0; v < data.numVertices(); ++v) {
    data.getEdges(v, next);
    CHECK_FALSE(next.empty());
    for (const unsigned int w : next) {
      if (!world.si->checkMotion(data.getVertex(v).getState(), data.getVertex(w).getState())) ++blocked;
    }
  }
  CHECK(blocked == 0);
}

TEST_CASE("states that are no numbers are not valid, nor are motions to them") {
  const PlannedWorld world;
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const ob::ScopedState<> good = at(world.si, 1, 1, 1);
    const ob::ScopedState<> state = at(world.si, 1, bad, 1);
    CHECK_FALSE(world.si->isValid(state.get()));
    CHECK_FALSE(world.si->checkMotion(good.get(), state.get()));
    CHECK_FALSE(world.si->checkMotion(state.get(), good.get()));
    CHECK(world.si->getStateValidityChecker()->clearance(state.get()) == -HUGE_VAL);
    ob::ScopedState<> last = at(world.si, 0, 0, 0);
    std::pair<ob::State*, double> valid(last.get(), -1.0);
    CHECK_FALSE(world.si->checkMotion(good.get(), state.get(), valid));
    CHECK(valid.second == 0);
    CHECK(last == good);
  }
}

TEST_CASE("states are printed with their rationals") {
  const PlannedWorld world;
  ob::ScopedState<> state = at(world.si, 0.25, 1, 1);
  const auto text = [&] {
    std::ostringstream out;
    state.print(out);
    return out.str();
  };
  CHECK(text() == "RealVectorState [0.25 1 1]\n");
  state->as<StateType>()->setExact({Rational(1, 3), -2, 0});
  CHECK(text() == "ExactTranslationState [1/3 -2 0]\n");
}

TEST_CASE("clearance counts forbidden edges and points that bound no facet") {
  Scene scene;
  scene.robot = make_point({0, 0, 0});
  scene.obstacles = {make_segment({0, 0, 0}, {4, 0, 0}), make_point({0, 9, 0})};
  scene.obstacle_names = {"segment", "point"};
  scene.contact = ContactRule::kForbid;
  TranslationPlanning setup{Problem(scene)};
  setup.setup();
  const ob::StateValidityCheckerPtr& checker = setup.getStateValidityChecker();
  CHECK(checker->clearance(at(setup.getSpaceInformation(), 2, 3, 0).get()) == 3);
  CHECK(checker->clearance(at(setup.getSpaceInformation(), 0, 7, 0).get()) == 2);
  CHECK_FALSE(checker->isValid(at(setup.getSpaceInformation(), 2, 0, 0).get()));
}

}  // namespace
}  // namespace nef::planner::test
