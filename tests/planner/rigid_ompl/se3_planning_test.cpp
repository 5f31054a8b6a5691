// SPDX-License-Identifier: Apache-2.0
//
// Stock planners of OMPL for rigid bodies. Their paths are checked at exact poses by Booleans of the moved robot.
#include "apps/planner/rigid_ompl/se3_planning.h"

#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/util/RandomNumbers.h>

#include <catch2/catch.hpp>

#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/free_space/collision.h"
#include "apps/planner/ompl/position_bounds.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::se3_planning {
namespace {

// A bar that has to lie down to pass through a window, from a quarter turn about x to one about y.
std::string window(const std::string& goal) {
  return R"J({"robot": "box(-3,-1/2,-1/2, 3,1/2,1/2)", "obstacles": ["box(-9,-9,-1, 9,9,1) - box(-2,-2,-1, 2,2,1)"],
    "box": [[-8, -8, -9], [8, 8, 9]], "rotation": "SO(3)",
    "start": {"position": [0, 0, -5], "quaternion": [1, 1, 0, 0]},
    "goal": {"position": [)J" +
         goal + R"J(], "quaternion": [1, 0, 1, 0]}})J";
}

TEST_CASE("A stock planner takes a bar through a window, from exact start to exact goal", "[rigid]") {
  ompl::RNG::setSeed(1);
  const Scene scene = scene_of(window("0, 0, 5"));
  const auto checker = std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene));
  const RigidAnswer answer = run_rigid_ompl(scene, checker, "rrtconnect", 200);  // far more than it needs
  REQUIRE(answer.status == AnswerStatus::kPath);
  REQUIRE(answer.path.size() > 2);
  CHECK(answer.path.front().position == Rational3{0, 0, -5});
  CHECK(answer.path.front().quaternion == Quaternion{1, 1, 0, 0});
  CHECK(answer.path.back().position == Rational3{0, 0, 5});
  CHECK(answer.path.back().quaternion == Quaternion{1, 0, 1, 0});
  CHECK(answer.certified.motions.size() == answer.path.size() - 1);
  for (std::size_t i = 1; i < answer.path.size(); ++i) {
    const RigidMotion motion(answer.path[i - 1], answer.path[i], MotionTiming::kSlerp);
    for (int k = 0; k <= 8; ++k) CHECK_FALSE(find_collision(scene, motion.at(k / 8.0)));
  }
}

TEST_CASE("Stock planners for rigid bodies: what is refused, and what is not found", "[rigid]") {
  const Scene scene = scene_of(window("0, 0, 5"));
  const auto checker = std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene));
  CHECK_THROWS_WITH(run_rigid_ompl(scene, checker, "TightPlanner", 1), Catch::Contains("only translates"));
  CHECK_THROWS_AS(SE3Planning(scene_of(corner("2.5")), checker), InputError);
  const Scene inside = scene_of(window("5, 0, 0"));
  const auto there = std::make_shared<const MotionChecker>(MotionChecker::of_scene(inside));
  const RigidAnswer invalid = run_rigid_ompl(inside, there, "RRTConnect", 1);
  CHECK(invalid.status == AnswerStatus::kInvalidGoal);
  CHECK(invalid.collision);

  const Folder folder;
  const std::string file = folder.write("window.json", window("0, 0, 5"));
  const Run found = planner(folder, file + " --ompl RRTConnect --time 100 --json -o " + folder.file("way.json"));
  REQUIRE(found.code == 0);
  CHECK(planner(folder, file + " --path " + folder.file("way.json")).code == 0);
  std::string closed = window("0, 0, 5");
  closed.replace(closed.find("- box(-2,-2,-1, 2,2,1)"), 22, "");
  const Run none = planner(folder, folder.write("closed.json", closed) + " --ompl RRTConnect --time 0.1");
  CHECK(none.code == 4);
  CHECK_THAT(none.out, Catch::Contains("RRTConnect found no path in time, which proves nothing"));
}

TEST_CASE("A stock planner is not asked if doubles round a start in contact into the obstacle", "[rigid]") {
  const Folder folder;
  const auto run = [&](const std::string& x) {  // a cube beside a wall that ends at x = 1/3
    const std::string scene = R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(-5,-5,-5, 1/3,5,5)"],
        "rotation": "SO(3)", "start": {"position": [5, 0, 0], "quaternion": [1, 0, 0, 0]},
        "goal": {"position": [")J" +
                              x + R"J(", 0, 0], "quaternion": [1, 0, 0, 0]}})J";
    return planner(folder, folder.write("beside.json", scene) + " --ompl RRTConnect --time 60");
  };
  const Run touching = run("1/3");  // its double is less
  CHECK(touching.code == 2);
  CHECK_THAT(touching.err, Catch::Contains("the goal is free, but not once it is rounded"));
  CHECK(run("11/32").code == 0);  // a double
  CHECK(run("1/4").code == 3);
}

TEST_CASE("Poses become states of length 1, and positions are bounded by the box or by what there is", "[rigid]") {
  const auto space = std::make_shared<ompl::base::SE3StateSpace>();
  space->setBounds(position_bounds(scene_of(window("0, 0, 5"))));
  ompl::base::ScopedState<> state(space);
  set_pose({{1, Rational(1, 3), -2}, {3, 0, 4, 0}}, state.get());
  CHECK(space->satisfiesBounds(state.get()));
  const std::optional<RigidPose> pose = pose_of(*space, state.get());
  REQUIRE(pose);
  CHECK(pose->position[1] == exact_rational(1.0 / 3));
  CHECK(nearest_double(pose->quaternion[0]) == Approx(0.6));
  CHECK(nearest_double(pose->quaternion[2]) == Approx(0.8));

  Scene open;
  open.robot = make_box({0, 0, 0}, {1, 1, 1});
  open.start = Rational3{-5, 0, 0};
  open.obstacles.push_back(make_box({0, 0, 0}, {7, 1, 1}));
  const ompl::base::RealVectorBounds bounds = position_bounds(open);
  CHECK(bounds.low[0] < -6);
  CHECK(bounds.high[0] > 8);
  CHECK(bounds.high[1] > 2);
}

}  // namespace
}  // namespace nef::planner::test::se3_planning
