// SPDX-License-Identifier: Apache-2.0
//
// The pieces of C++ on docs/ompl.md and docs/rigid.md, as they are printed there (tests/docs/check_snippets.py compares
// them).
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>

#include "apps/planner/linkage/linkage_checker.h"
#include "apps/planner/linkage_ompl/linkage_validity.h"
#include "apps/planner/linkage_urdf/urdf_robot.h"
#include "apps/planner/ompl/translation_planning.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

using MyPlanner = ompl::geometric::RRTConnect;

TEST_CASE("the page for users of OMPL: a planner of one's own") {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const nef::Polyhedron robot = nef::make_box({0, 0, 0}, {1, 1, 1});
  const nef::Polyhedron wall = nef::make_box({4, 0, 0}, {5, 3, 3});
  const nef::Rational3 start{0, 0, 0};
  const nef::Rational3 goal{0, 5, 0};
  nef::planner::TranslationPlanning setup;
  setup.setRobot(robot);
  setup.addObstacle(wall);
  setup.setExactStartAndGoal(start, goal);
  setup.setPlanner(std::make_shared<MyPlanner>(setup.getSpaceInformation()));
  setup.solve(10.0);
  CHECK(setup.haveExactSolutionPath());
}

TEST_CASE("the page on rigid motions: exact checks in a setup of OMPL") {
  const nef::planner::Scene scene =
      nef::planner::test::scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(4,0,0, 5,3,3)"]})J");
  ompl::geometric::SimpleSetup setup(std::make_shared<ompl::base::SE3StateSpace>());
  const auto checker =
      std::make_shared<const nef::planner::MotionChecker>(nef::planner::MotionChecker::of_scene(scene));
  const auto si = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<nef::planner::RigidStateValidityChecker>(si, checker));
  si->setMotionValidator(std::make_shared<nef::planner::RigidMotionValidator>(si, checker));
  CHECK(setup.getStateValidityChecker() != nullptr);
}

TEST_CASE("the page on rigid motions: a linkage") {
  const nef::Polyhedron arm = nef::make_box({0, 0, 0}, {3, 1, 1});
  const auto obstacles = nef::planner::RigidBody::of_set(nef::make_box({0, 2, 0}, {1, 3, 3}));
  ompl::geometric::SimpleSetup setup(std::make_shared<ompl::base::RealVectorStateSpace>(1));
  const auto si = setup.getSpaceInformation();
  nef::planner::Linkage robot;  // link 0 is the base, which stays
  robot.links.push_back({"base", std::nullopt, {}});
  robot.links.push_back(
      {"arm", nef::planner::RigidBody::of_set(arm), {nef::planner::LinkageJoint::Kind::kRevolute, 0, {0, 0, 1}}});
  const auto checker = std::make_shared<const nef::planner::LinkageChecker>(robot, obstacles);
  setup.setStateValidityChecker(std::make_shared<nef::planner::LinkageStateValidityChecker>(si, checker));
  si->setMotionValidator(std::make_shared<nef::planner::LinkageMotionValidator>(si, checker));
  const std::vector<double> at_rest{0};
  const std::vector<double> turned{1.5};
  CHECK(checker->check(at_rest).status == nef::planner::MotionVerdict::Status::kFree);
  CHECK(checker->check(at_rest, turned).status == nef::planner::MotionVerdict::Status::kCollides);
}

namespace {

// Only compiled: not every build reads URDF files.
[[maybe_unused]] bool rests(const nef::planner::RigidBody& obstacles) {
  const nef::planner::UrdfRobot crane =
      nef::planner::read_urdf("data/planner/linkage/crane.urdf", "data/planner/linkage/crane.srdf");
  const nef::planner::LinkageChecker checker(crane.linkage(), obstacles);
  const std::vector<double> at_rest(3, 0.0);
  return checker.check(at_rest).status == nef::planner::MotionVerdict::Status::kFree;
}

}  // namespace
