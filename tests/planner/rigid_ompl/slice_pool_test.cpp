// SPDX-License-Identifier: Apache-2.0
//
// Samples from slices (slice_pool.h, sliced_space.h): they are free, by Booleans of the moved robot, and with them a
// stock planner passes where as many uniform samples do not suffice.
#include "apps/planner/rigid_ompl/slice_pool.h"

#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <atomic>
#include <catch2/catch.hpp>

#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "apps/planner/rigid_ompl/se3_planning.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::slice_pool {
namespace {

namespace ob = ompl::base;

// A bar, 1 high, in front of a wall with a square hole; behind it the bar is turned.
Scene hole_of(const std::string& half) {
  return scene_of(R"J({"robot": "box(-2,-1/2,-1/2, 2,1/2,1/2)", "obstacles": ["box(-1,-9,-9, 1,9,9) - box(-1,-)J" +
                  half + ",-" + half + ", 1," + half + "," + half + R"J()"], "box": [[-8,-8,-8],[8,8,8]],
    "rotation": "SO(3)", "start": {"position": [-5,1,0], "quaternion": [1,0,0,1]},
    "goal": {"position": [5,0,-1], "quaternion": [1,1,2,0]}})J");
}

std::shared_ptr<const MotionChecker> checker_of(const Scene& scene) {
  return std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene));
}

TEST_CASE("Poses from slices are free, and some are in the hole, where as many uniform ones are not", "[rigid]") {
  const Scene scene = hole_of("11/20");
  const SE3Planning setup(scene, checker_of(scene));
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  SlicePool& pool = *setup.space().getSlices();
  ob::ScopedState<> state(si);
  ompl::RNG random(3);
  CHECK_FALSE(pool.draw(setup.space(), state.get(), random));  // there are none yet
  for (int i = 0; i < 500; ++i) pool.countDraw();
  CHECK(pool.sliceCount() > 2);
  const auto is_in_hole = [](const RigidPose& pose) { return abs(pose.position[0]) < 1; };
  int in_hole = 0;
  for (int i = 0; i < 500; ++i) {
    REQUIRE(pool.draw(setup.space(), state.get(), random));
    REQUIRE(si->isValid(state.get()));
    const RigidPose pose = *pose_of(setup.space(), state.get());
    if (i % 10 == 0) CHECK_FALSE(find_collision(scene, pose));
    if (is_in_hole(pose)) ++in_hole;
  }
  CHECK(in_hole > 0);
  setup.space().setSliceShare(0);
  const ob::StateSamplerPtr uniform = si->allocStateSampler();
  for (int i = 0; i < 500; ++i) {
    uniform->sampleUniform(state.get());
    const RigidPose pose = *pose_of(setup.space(), state.get());
    if (is_in_hole(pose)) CHECK_FALSE(si->isValid(state.get()));
  }
}

TEST_CASE("No slices are made once what stops the pool has stopped, and those that are there are drawn from",
          "[rigid]") {
  const Scene scene = hole_of("11/20");
  std::atomic<bool> stop{true};
  for (const bool from_the_start : {true, false}) {
    const SE3Planning setup(scene, checker_of(scene));
    SlicePool& pool = *setup.space().getSlices();
    stop = from_the_start;
    pool.setMonitor(Monitor().stopped_by(&stop));
    for (int i = 0; i < 100; ++i) pool.countDraw();
    const std::size_t made = pool.sliceCount();
    CHECK((made == 0) == from_the_start);
    stop = true;
    for (int i = 0; i < 500; ++i) pool.countDraw();
    CHECK(pool.sliceCount() == made);
    ob::ScopedState<> state(setup.getSpaceInformation());
    ompl::RNG random(3);
    CHECK(pool.draw(setup.space(), state.get(), random) == !from_the_start);
  }
}

TEST_CASE("Nothing is drawn from slices of scenes without obstacles", "[rigid]") {
  const Scene scene = scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": [], "rotation": "SO(3)",
      "start": {"position": [-2,0,0], "quaternion": [1,0,0,0]}, "goal": {"position": [2,0,0], "quaternion": [1,2,0,0]}})J");
  const SE3Planning setup(scene, checker_of(scene));
  SlicePool& pool = *setup.space().getSlices();
  ob::ScopedState<> state(setup.getSpaceInformation());
  ompl::RNG random(3);
  for (int i = 0; i < 100; ++i) pool.countDraw();
  CHECK(pool.sliceCount() > 0);
  CHECK_FALSE(pool.draw(setup.space(), state.get(), random));
}

// Whether RRTConnect finds a path with so many draws.
bool finds_path(const Scene& scene, double share, unsigned draws) {
  SE3Planning setup(scene, checker_of(scene));
  setup.space().setSliceShare(share);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  ob::IterationTerminationCondition enough(draws);
  setup.solve(enough);
  CHECK((setup.space().getSlices()->sliceCount() > 0) == (share > 0));
  return setup.haveExactSolutionPath();
}

TEST_CASE("With samples from slices a stock planner passes where uniform ones do not suffice", "[rigid]") {
  ompl::RNG::setSeed(1);
  constexpr unsigned kDraws = 3000;
  for (const char* half : {"11/20", "1/2"}) {  // with room to spare, and exactly of the bar's size
    INFO(half);
    const Scene scene = hole_of(half);
    CHECK(finds_path(scene, 0.3, kDraws));
    CHECK_FALSE(finds_path(scene, 0, kDraws));
  }
}

}  // namespace
}  // namespace nef::planner::test::slice_pool
