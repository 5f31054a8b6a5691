// SPDX-License-Identifier: Apache-2.0
//
// Stock planners of OMPL for robots that turn.
#include "apps/planner/turning_ompl/turning_planning.h"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>

#include "apps/planner/ompl/ompl_planners.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;

TEST_CASE("stock planners turn the bar round the corner") {
  const Scene scene = scene_of(corner("2.5"));
  const Polyhedron obstacles = unite_all(scene.obstacles);
  for (const char* name : {"RRTConnect", "PRM", "KPIECE1", "EST"}) {
    INFO(name);
    TurningPlanning setup(scene);
    setup.setPlanner(make_ompl_planner(name, setup.getSpaceInformation()));
    REQUIRE(setup.solve(200.0) == ob::PlannerStatus::EXACT_SOLUTION);  // far more than any needs, under sanitizers too
    ompl::geometric::PathGeometric path = setup.getSolutionPath();
    CHECK(path.check());
    path.interpolate(60);
    for (const ob::State* state : path.getStates()) {
      const Pose pose = setup.space().pose(state);
      AffineMap map = setup.space().axis().rotation(pose.turn);
      map.translation = pose.position;
      CHECK(intersect(interior(transform(scene.robot, map)), obstacles).is_empty());
      CHECK(pose.position[2] == 0);
    }
  }
}

TEST_CASE("stock planners for robots that turn, on the command line") {
  const Folder folder;
  const std::string scene = folder.write("corner.json", corner("2.5"));
  const Run run = planner(folder, scene + " --ompl rrtconnect --time 30 -o " + folder.file("way.txt"));
  CHECK(run.code == 0);
  CHECK_THAT(text_of(folder.file("way.txt")), Catch::StartsWith("-12 -1 0 0\n"));
  const Run unsolved = planner(folder, folder.write("long.json", corner("3.9")) + " --ompl RRTConnect --time 0.2");
  CHECK(unsolved.code == 4);
  CHECK_THAT(unsolved.out, Catch::Contains("which proves nothing"));
  CHECK(planner(folder, scene + " --ompl TightPlanner").code == 2);
}

TEST_CASE("informed samplers work on poses: BIT* and its family find ways round a box") {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const Scene scene = scene_of(R"J({"robot": "box(-1,-1/4,0, 1,1/4,1)", "obstacles": ["box(2,-2,-1, 3,2,2)"],
    "start": [0,0,0,0], "goal": [5,0,0,90], "rotation": {}, "box": [[-4,-6,-1],[9,6,1]]})J");
  for (const char* name : {"BITstar", "InformedRRTstar", "AITstar"}) {
    INFO(name);
    TurningPlanning setup(scene);
    setup.setPlanner(make_ompl_planner(name, setup.getSpaceInformation()));
    // Any path will do: they go on improving theirs for as long as they may otherwise.
    const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(setup.getSpaceInformation());
    objective->setCostThreshold(objective->infiniteCost());
    setup.setOptimizationObjective(objective);
    REQUIRE_NOTHROW(setup.solve(ob::timedPlannerTerminationCondition(30.0)));
    CHECK(setup.haveExactSolutionPath());
    CHECK(setup.getSolutionPath().check());
  }
}

}  // namespace
}  // namespace nef::planner::test
