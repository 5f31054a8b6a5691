// SPDX-License-Identifier: Apache-2.0
//
// Paths with rotations through files, the program and OMPL's stock space.
#include "apps/planner/rigid/certified_path.h"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <catch2/catch.hpp>

#include "apps/planner/rigid/pose_file.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/temporary_folder.h"

namespace nef::planner::test::certified_path {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Status = MotionVerdict::Status;

// A plate with a slot exactly as high as the bar.
Scene slot() {
  return scene_of(R"J({"robot": "box(-2,-1/4,-1/2, 2,1/4,1/2)",
      "obstacles": ["box(-6,4,-6, 6,5,6) - box(-3,4,-1/2, 3,5,1/2)"]})J");
}

RigidPose pose(const Rational3& position, const Quaternion& quaternion = {1, 0, 0, 0}) {
  return {position, quaternion};
}

TEST_CASE("A path with rotations is certified motion by motion", "[rigid]") {
  const MotionChecker checker = MotionChecker::of_scene(slot());
  const std::vector<RigidPose> good{pose({0, 0, 0}, {1, 0, 0, 1}), pose({0, 1, 0}), pose({0, 9, 0}),
                                    pose({0, 12, 0}, {1, 0, 0, 1})};
  const CertifiedPath certified = certify(checker, good);
  CHECK(certified.status == Status::kFree);
  CHECK(certified.motions[1].touches);  // the slot is as high as the bar
  // Turned by 90 degrees about z it passes, too: its length lies along the way then.
  const std::vector<RigidPose> along{good[0], pose({0, 9, 0}, {1, 0, 0, 1})};
  CHECK(certify(checker, along).status == Status::kFree);
  // Turned about x only a little, it is higher than the slot.
  const std::vector<RigidPose> askew{pose({0, 0, 0}, {9, 1, 0, 0}), pose({0, 9, 0}, {9, 1, 0, 0})};
  const CertifiedPath caught = certify(checker, askew);
  CHECK(caught.status == Status::kCollides);
  CHECK(caught.blocked == 0);
  CHECK_THROWS_AS(certify(checker, {}), InputError);
}

TEST_CASE("Poses are read from seven columns and from JSON", "[rigid]") {
  const nef::test::TemporaryFolder folder;
  const auto any_turned = [](const std::vector<RigidPose>& path) {
    return std::any_of(path.begin(), path.end(), is_turned);
  };
  const auto lines = read_path(folder.write("a.path", "0 0 0 0 0 0 1 \n1 2.5 3 0 0 1/2 0.5 \n\n"));
  REQUIRE(lines.size() == 2);
  CHECK(any_turned(lines));
  CHECK(lines[1].position == Rational3{1, ratio(5, 2), 3});
  CHECK(lines[1].quaternion == Quaternion{ratio(1, 2), 0, 0, ratio(1, 2)});
  const auto still = read_path(folder.write("b.path", "0 0 0 0 0 0 2\n1 2 3 0 0 0 1\n"));
  CHECK_FALSE(any_turned(still));
  CHECK(still[0].quaternion == Quaternion{1, 0, 0, 0});
  CHECK_FALSE(any_turned(read_path(folder.write("c.path", "0 0 0\n1 2 3\n"))));
  const auto json =
      read_path(folder.write("d.json", R"J({"path": [{"position": [0, "1/3", 0.5], "quaternion": [1, 1, 0, 0]}]})J"));
  CHECK(any_turned(json));
  CHECK(json[0].position == Rational3{0, ratio(1, 3), ratio(1, 2)});
  CHECK(read_path(folder.write("f.json", R"J({"path": [[0, "1/3", 0.5]]})J"))[0].position == json[0].position);
  CHECK_THROWS_WITH(read_path(folder.write("e.path", "0 0 0 0 0 1 1\n0 0 0 0 0 0 0\n")),
                    Catch::Contains("e.path:2") && Catch::Contains("zero"));
}

TEST_CASE("planner --path certifies poses that are turned", "[rigid]") {
  const Folder folder;
  const std::string scene = folder.write("scene.json", R"J({"robot": "box(-2,-1/4,-1/2, 2,1/4,1/2)",
      "obstacles": ["box(-6,4,-6, 6,5,6) - box(-3,4,-1/2, 3,5,1/2)"]})J");
  const std::string good = folder.write("good.path", "0 0 0 0 0 1 1\n0 1 0 0 0 0 1\n0 9 0 0 0 0 1\n");
  const Run passes = planner(folder, scene + " --path " + good);
  CHECK(passes.code == 0);
  CHECK(passes.out == "path: all 2 motions are free\n");
  const std::string bad = folder.write("bad.path", "0 0 0 0 0 1 1\n0 0 0 1 0 0 9\n0 9 0 1 0 0 9\n");
  const Run blocked = planner(folder, scene + " --json --path " + bad);
  CHECK(blocked.code == 1);
  CHECK_THAT(blocked.out, Catch::Contains(R"("blocked_segment": 1)") && Catch::Contains(R"("status": "blocked")"));
  // To look at: the robot moves, and a blocked path ends where it collides.
  const std::string shown = " --page " + folder.file("p.html") + " -o " + folder.file("p.glb");
  CHECK(planner(folder, scene + " --path " + good + shown).code == 0);
  CHECK(planner(folder, scene + " --path " + bad + " -o " + folder.file("bad.glb")).code == 1);
  for (const char* file : {"p.glb", "bad.glb"}) {
    CHECK_THAT(text_of(folder.file(file)),
               Catch::Contains(R"("path":"rotation")") && Catch::Contains(R"("path":"translation")"));
  }
  CHECK_THAT(text_of(folder.file("p.html")), Catch::Contains("</html>"));
  const Run refused = planner(folder, scene + " --tight --path " + good);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::Contains("a path with rotations excludes --tight"));
}

TEST_CASE("Paths of .cfg scenes are those of the robot in its own file", "[rigid]") {
  const Folder folder;
  // Start and goal of the scene are turned by .3 about z; turned back, the cube fits the hole exactly.
  const std::string scene = source_folder() + "/data/planner/omplapp/wall_turned.cfg --path ";
  const std::string fits =
      folder.write("fits.path", "2 1.5 -1.5 0 0 0.15 0.99\n2 1.5 -1.5 0 0 0 1\n7 1.5 -1.5 0 0 0 1\n");
  CHECK(planner(folder, scene + fits).code == 0);
  const std::string turned = folder.write("turned.path", "2 1.5 -1.5 0 0 0.15 0.99\n7 1.5 -1.5 0 0 0.15 0.99\n");
  CHECK(planner(folder, scene + turned).code == 1);
}

// The plate and a bar in the plane z = 0 for the stock spaces.
template <typename Space>
og::SimpleSetup setup_with(const std::shared_ptr<Space>& space, const std::shared_ptr<const MotionChecker>& checker,
                           unsigned dimension) {
  ob::RealVectorBounds bounds(dimension);
  bounds.setLow(-8);
  bounds.setHigh(14);
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  setup.setStateValidityChecker(std::make_shared<RigidStateValidityChecker>(setup.getSpaceInformation(), checker));
  setup.getSpaceInformation()->setMotionValidator(
      std::make_shared<RigidMotionValidator>(setup.getSpaceInformation(), checker));
  return setup;
}

TEST_CASE("A stock planner on SE(3) returns paths that hold between samples", "[rigid]") {
  ompl::RNG::setSeed(3);
  Scene scene = slot();
  scene.obstacles[0] = scene_of(R"J({"robot": "box(0,0,0, 1,1,1)",
      "obstacles": ["box(-6,4,-6, 6,5,6) - box(-3,4,-2, 3,5,2)"]})J")
                           .obstacles[0];
  const auto checker = std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene));
  const auto space = std::make_shared<ob::SE3StateSpace>();
  og::SimpleSetup setup = setup_with(space, checker, 3);
  ob::ScopedState<ob::SE3StateSpace> start(space);
  start->setXYZ(0, 0, 0);
  start->rotation().setAxisAngle(0, 0, 1, 1.2);
  ob::ScopedState<ob::SE3StateSpace> goal(space);
  goal->setXYZ(0, 11, 0);
  goal->rotation().setAxisAngle(1, 0, 0, 0.7);
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
  REQUIRE(setup.solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  setup.simplifySolution(2.0);
  og::PathGeometric& path = setup.getSolutionPath();
  CHECK(path.check());
  // Again by exact Booleans of the robot, at many poses.
  path.interpolate(200);
  for (const ob::State* state : path.getStates()) {
    const RigidPose at = *pose_of(*space, state);
    const Polyhedron robot =
        transform(scene.robot, AffineMap{rotation_between(at.quaternion, at.quaternion), at.position});
    CHECK(intersect(interior(robot), interior(scene.obstacles[0])).is_empty());
  }
}

TEST_CASE("The last valid state of a motion on SE(2) is before the first collision", "[rigid]") {
  const auto checker = std::make_shared<const MotionChecker>(MotionChecker::of_scene(
      scene_of(R"J({"robot": "box(-1,-1/4,0, 1,1/4,1)", "obstacles": ["box(4,-6,-1, 5,6,2)"]})J")));
  const auto space = std::make_shared<ob::SE2StateSpace>();
  og::SimpleSetup setup = setup_with(space, checker, 2);
  setup.getSpaceInformation()->setup();
  ob::ScopedState<ob::SE2StateSpace> from(space);
  from->setXY(0, 0);
  from->setYaw(0);
  ob::ScopedState<ob::SE2StateSpace> to(space);
  to->setXY(8, 0);
  to->setYaw(0);
  ob::ScopedState<ob::SE2StateSpace> last(space);
  std::pair<ob::State*, double> valid(last.get(), -1.0);
  CHECK_FALSE(setup.getSpaceInformation()->getMotionValidator()->checkMotion(from.get(), to.get(), valid));
  // The bar touches the wall at x = 3.
  CHECK(valid.second <= 3.0 / 8);
  CHECK(valid.second >= 3.0 / 8 - 1.0 / 1024);
  CHECK(last->getX() == Approx(8 * valid.second));
  CHECK(setup.getStateValidityChecker()->isValid(last.get()));
  CHECK_THROWS_AS(RigidStateValidityChecker(
                      std::make_shared<ob::SpaceInformation>(std::make_shared<ob::RealVectorStateSpace>(3)), checker),
                  InputError);
}

}  // namespace
}  // namespace nef::planner::test::certified_path
