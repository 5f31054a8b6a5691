// SPDX-License-Identifier: Apache-2.0
//
// Obstacles that come and go: the answers are those of a new start.
#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/ompl/translation_planning.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

Polyhedron random_obstacle(std::mt19937& random) {
  Rational3 low;
  Rational3 high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = static_cast<int>(random() % 7);
    high[i] = low[i] + static_cast<int>(random() % 4);  // flat ones, too
  }
  return make_box(low, high);
}

TEST_CASE("an unbounded robot is refused, with and without obstacles") {
  Scene scene;
  scene.robot = complement(make_box({0, 0, 0}, {1, 1, 1}));
  CHECK_THROWS_WITH(free_positions(scene), Catch::Contains("the robot is unbounded"));
  CHECK_THROWS_WITH(reachable_part(make_box({0, 0, 0}, {1, 1, 1}), scene, {}),
                    Catch::Contains("the robot is unbounded"));
}

TEST_CASE("free positions after obstacles came, went and moved are those of a new start") {
  for (unsigned seed = 0; seed < nef::test::fewer(24); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Scene scene;
    scene.robot = seed % 3 == 0 ? unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 0, 0}, {2, 1, 2}))
                                : make_box({0, 0, 0}, {1, 2, 1});
    scene.contact = seed % 4 == 3 ? ContactRule::kForbid : ContactRule::kAllow;
    if (seed % 4 == 3 && seed % 8 == 3) scene.robot = unite(scene.robot, make_segment({0, 0, 0}, {-2, 0, 0}));
    if (seed % 2 == 0) scene.box = {Rational3{-3, -3, -3}, Rational3{12, 12, 12}};
    REQUIRE(obstacles_are_independent(scene));
    Polyhedron free = free_positions(scene);
    for (int step = 0; step < 10; ++step) {
      ObstacleChange change;
      if (scene.obstacles.size() > 2 && random() % 3 == 0) {
        change.index = random() % scene.obstacles.size();
      } else {
        if (scene.obstacles.size() > 1 && random() % 3 == 0) change.index = random() % scene.obstacles.size();
        change.obstacle = random_obstacle(random);
      }
      free = free_positions_after(change, scene, free);
      apply(change, scene);
      CHECK(equal(free, free_positions(scene)));
    }
  }
}

// A cube is to go along a room, over a step of its height.
void put_step_between(TranslationPlanning& setup) {
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.setEnvironmentBounds({0, 0, 0}, {8, 2, 2});
  setup.addObstacle(make_box({4, 0, 0}, {5, 3, 1}));
  setup.setExactStartAndGoal({0, 0, 0}, {8, 0, 0});
}

TEST_CASE("TranslationPlanning: obstacles come and go between queries") {
  namespace ob = ompl::base;
  TranslationPlanning setup;
  put_step_between(setup);
  CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const auto ask = [&] {
    setup.clear();
    return setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION;
  };
  const auto same = [&] { return equal(setup.getFreeSpace()->set(), free_positions(setup.getScene())); };
  setup.addObstacle(make_box({4, 0, 1}, {5, 3, 3}));  // closes the way
  CHECK_FALSE(ask());
  CHECK(setup.getProblemDefinition()->hasSolutionNonExistenceProof());
  CHECK_FALSE(setup.getFreeSpace()->has_roadmap());  // a proof needs none
  CHECK(same());
  setup.addObstacle(make_box({20, 0, 0}, {21, 1, 1}));
  setup.removeObstacle(0);
  CHECK(ask());
  CHECK(same());
  for (int i = 0; i < 12; ++i) setup.addObstacle(make_box({30 + i, 0, 0}, {31 + i, 1, 1}));
  setup.addObstacle(make_box({4, 0, 0}, {5, 3, 1}));
  CHECK_FALSE(ask());
  CHECK(same());
  CHECK_THROWS_AS(setup.removeObstacle(99), std::out_of_range);
  CHECK_THROWS_AS(setup.moveObstacle(99, Rational3{1, 0, 0}), std::out_of_range);
}

TEST_CASE("TranslationPlanning: an obstacle moves") {
  namespace ob = ompl::base;
  TranslationPlanning setup;
  put_step_between(setup);
  setup.addObstacle(make_box({4, 0, 2}, {5, 3, 3}));  // a slit as high as the robot
  const auto ask = [&] {
    setup.clear();
    const bool found = setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION;
    CHECK(equal(setup.getFreeSpace()->set(), free_positions(setup.getScene())));
    return found;
  };
  CHECK(ask());
  setup.moveObstacle(1, Rational3{0, 0, Rational(-1, 1000)});  // a hair too low
  CHECK_FALSE(ask());
  setup.moveObstacle(1, Rational3{0, 0, Rational(1, 1000)});
  setup.addObstacle(make_box({2, 0, 0}, {Rational(5, 2), 3, 1}));
  CHECK(ask());
  CHECK(setup.getTightPlanner()->getExactPath()->thinness.piece == 2);
  // A quarter turn about the vertical takes the lower bar out of the way.
  AffineMap turn = AffineMap::identity();
  turn.linear = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  setup.moveObstacle(0, turn);
  CHECK(ask());
  CHECK(setup.getTightPlanner()->getExactPath()->thinness.piece == 3);
  REQUIRE(setup.getScene().obstacles.size() == 3);
  CHECK(equal(setup.getScene().obstacles[0], make_box({-3, 4, 0}, {0, 5, 1})));
}

TEST_CASE("TranslationPlanning: an obstacle that leaves the way free leaves the way") {
  namespace ob = ompl::base;
  TranslationPlanning setup;
  setup.setRobot(make_box({0, 0, 0}, {1, 1, 1}));
  setup.addObstacle(make_box({4, -3, -3}, {5, 3, 3}));
  setup.setExactStartAndGoal({0, 0, 0}, {8, 0, 0});
  REQUIRE(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const auto points = [&] { return setup.getTightPlanner()->getExactPath()->points; };
  const std::vector<Rational3> first = points();
  const auto ask = [&] {
    setup.clear();
    REQUIRE(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
    CHECK(equal(setup.getFreeSpace()->set(), free_positions(setup.getScene())));
    CHECK(describe_path(*setup.getFreeSpace(), points()).has_value());
    return points();
  };
  setup.addObstacle(make_box({20, 0, 0}, {21, 1, 1}));
  CHECK(ask() == first);
  // One on the way.
  const Rational3& bend = first[1];
  setup.addObstacle(make_box(bend, {bend[0] + Rational(1, 100), bend[1] + 1, bend[2] + 1}));
  const std::vector<Rational3> second = ask();
  CHECK(second != first);
  // Once it has gone the old way is the best again, though the one in between is still free.
  setup.removeObstacle(2);
  CHECK(ask() == first);
  // Another question, and other options, have other answers.
  setup.addObstacle(make_box({25, 0, 0}, {26, 1, 1}));
  setup.setExactStartAndGoal({0, 0, 0}, {0, 5, 0});
  CHECK(ask().size() == 2);
  setup.setExactStartAndGoal({0, 0, 0}, {8, 0, 0});
  CHECK(ask() == first);
  setup.addObstacle(make_box({30, 0, 0}, {31, 1, 1}));
  setup.getTightPlanner()->setMinDimension(3);
  ask();
  CHECK(setup.getTightPlanner()->getExactPath()->thinness.piece == 3);
}

}  // namespace
}  // namespace nef::planner::test
