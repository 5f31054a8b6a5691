// SPDX-License-Identifier: Apache-2.0
//
// The OMPL classes for robots that turn: exact poses, checks of poses and motions against slices of free space and
// against sets, our planner and stock planners.
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/segments.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/path/simple_points.h"
#include "apps/planner/turning_ompl/turning_planning.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;

// An L among turned boxes, all over the place.
Scene random_scene(std::mt19937& random, const std::string& axis, ContactRule contact) {
  Scene scene = scene_of(R"J({"robot": "box(-1,-1/2,0, 1,0,1) + box(-1,-1/2,0, -1/2,1,1/2)", "obstacles": [],
    "start": [0,0,0,0], "goal": [1,1,1,30], "rotation": {"axis": )J" +
                         axis + "}}");
  for (int i = 0; i < 5; ++i) {
    const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 9) - 4) / 2; };
    const Rational3 low{some(), some(), some()};
    const Polyhedron box = make_box(low, {low[0] + 1, low[1] + ratio(1, 2), low[2] + 2});
    scene.obstacles.push_back(i % 2 == 0 ? box : transform(box, AffineMap::rotate({1, 2, 2}, 40)));
    scene.obstacle_names.emplace_back("box");
  }
  scene.contact = contact;
  return scene;
}

TEST_CASE("the space of poses passes OMPL's sanity checks and keeps exact poses") {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  for (const Rational3& direction : {Rational3{0, 0, 1}, Rational3{1, 1, 1}}) {
    auto space = std::make_shared<TurningSpace>(TurningAxis(direction), 2.0);
    ob::RealVectorBounds bounds(3);
    bounds.setLow(-3);
    bounds.setHigh(3);
    space->setBounds(bounds);
    space->setup();
    CHECK_NOTHROW(space->sanityChecks());
    ob::State* a = space->allocState();
    ob::State* b = space->allocState();
    const Pose pose{{ratio(1, 3), 2, 0}, 1 + ratio(1, 7)};
    space->setPose(a, pose);
    CHECK(space->pose(a).position == pose.position);
    CHECK(space->pose(a).turn == pose.turn);
    space->copyState(b, a);
    CHECK(space->equalStates(a, b));
    CHECK(space->pose(b).turn == pose.turn);
    space->setPose(b, {{1, 1, 1}, 3 + ratio(1, 7)});  // OMPL's angles end at half a turn
    CHECK(space->pose(b).turn == ratio(1, 7) - 1);
    // Translations keep the turn.
    space->setPose(b, {{1, 1, 1}, pose.turn});
    ob::State* middle = space->allocState();
    space->interpolate(a, b, 0.5, middle);
    CHECK(space->pose(middle).turn == pose.turn);
    CHECK(space->pose(middle).position == Rational3{ratio(2, 3), ratio(3, 2), ratio(1, 2)});
    // An angle that somebody writes counts.
    auto* angle = middle->as<ob::CompoundState>()->as<TurnSpace::StateType>(1);
    angle->value = 0.25;
    CHECK(space->axis().degrees_of(space->pose(middle).turn) == Approx(0.25 * 180 / M_PI));
    for (ob::State* state : {a, b, middle}) space->freeState(state);
  }
}

TEST_CASE("poses and motions among random boxes are judged as free space says") {
  std::mt19937 random(5);
  std::size_t taken = 0;
  std::size_t touching = 0;
  for (const std::string axis : {R"("z")", "[1, 1, 1]"}) {
    for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
      const Scene scene = random_scene(random, axis, contact);
      const TurningAxis about = question_of(scene).axis;
      const TurningCollision collision(scene, about);
      const TurningRobot robot(scene.robot, about);
      for (int i = 0; i < 3; ++i) {
        const Turn turn = ratio(static_cast<long>(random() % 16), 4);
        Scene slice = scene;
        slice.rotation.reset();
        slice.robot = robot.at(turn);
        const FreeSpace free(free_positions(slice));
        for (int k = 0; k < 30; ++k) {
          const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 25) - 12) / 4; };
          const Rational3 from{some(), some(), some()};
          const Rational3 to{some(), some(), some()};
          const bool is_free = free.is_free(ExactPoint(from));
          CHECK(collision.is_free({from, turn}) == is_free);
          if (!is_free) ++taken;
          if (is_free && free.cells().dimension(free.locate(ExactPoint(from))) < 3) ++touching;
          CHECK(collision.is_free({from, turn}, {to, turn}) == !first_blocked_position(free, from, to).has_value());
        }
        // Corners of the obstacle: contact.
        for (CellId cell = 0; cell < free.cells().size() && free.cells().dimension(cell) == 0; ++cell) {
          const Rational3 vertex = free.vertices(cell).front();
          CHECK(collision.is_free({vertex, turn}) == free.is_free(cell));
        }
      }
    }
  }
  CHECK(taken > 10);
  CHECK(touching + taken > 12);
}

TEST_CASE("a motion that turns is called free only if it is, and is if there is room") {
  std::mt19937 random(8);
  std::size_t valid = 0;
  std::size_t refused = 0;
  const Scene scene = random_scene(random, R"("z")", ContactRule::kAllow);
  const TurningAxis axis = question_of(scene).axis;
  const TurningCollision collision(scene, axis);
  const TurningRobot robot(scene.robot, axis);
  const Polyhedron obstacles = unite_all(scene.obstacles);
  for (int i = 0; i < 120; ++i) {
    const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 25) - 12) / 4; };
    const Pose from{{some(), some(), some()}, ratio(static_cast<long>(random() % 16), 8)};
    const Pose to{{some(), some(), from.position[2]}, from.turn + ratio(static_cast<long>(random() % 9) - 4, 6)};
    if (!collision.is_free(from)) continue;
    const bool is_valid = collision.is_free(from, to);
    bool meets = false;
    for (int k = 0; k <= 8; ++k) {
      const double degrees = axis.degrees_of(from.turn) * (8 - k) / 8 + axis.degrees_of(to.turn) * k / 8;
      AffineMap map = axis.rotation(axis.turn_of_degrees(exact_rational(degrees)));
      for (std::size_t c = 0; c < 3; ++c) {
        map.translation[c] = from.position[c] + ratio(k, 8) * (to.position[c] - from.position[c]);
      }
      meets = meets || !intersect(interior(transform(scene.robot, map)), obstacles).is_empty();
    }
    CHECK_FALSE((is_valid && meets));
    ++(is_valid ? valid : refused);
  }
  CHECK(valid > 15);
  CHECK(refused > 3);
  // On the floor, and along a wall.
  const Scene floor = scene_of(R"J({"robot": "box(-1,-1,0, 1,1,1)", "obstacles": ["box(-9,-9,-1, 9,9,0)",
    "box(2,-9,0, 3,9,4)"], "start": [0,0,0,0], "goal": [0,0,0,90], "rotation": {}})J");
  const TurningCollision on_floor(floor, question_of(floor).axis);
  CHECK(on_floor.is_free({{0, 0, 0}, 0}, {{-1, 2, 0}, 1}));
  CHECK(on_floor.is_free({{1, 0, 0}, 0}, {{1, 3, 0}, 0}));
  CHECK_FALSE(on_floor.is_free({{1, 0, 0}, 0}, {{1, 0, 0}, 1}));  // its corners would go through the wall
  CHECK_FALSE(on_floor.is_free({{0, 0, 0}, 0}, {{0, 0, ratio(-1, 1000000000)}, ratio(1, 2)}));
  // A sheet between the parts of a robot is in its way, though it is on the border of both.
  Scene sheet = scene_of(R"J({"robot": "box(-2,-1,0, 0,1,1) + box(0,-1/2,0, 2,1/2,1)", "obstacles":
    ["box(-9,-9,-1, 9,9,0)", "box(0,-1/4,0, 0,1/4,9)"], "start": [0,0,0,0], "goal": [0,0,0,90], "rotation": {}})J");
  const TurningCollision with_sheet(sheet, question_of(sheet).axis);
  CHECK_FALSE(with_sheet.is_free({{0, 0, 0}, 0}));
  CHECK_FALSE(with_sheet.is_free({{0, 0, 0}, 1}));
  CHECK(with_sheet.is_free({{2, 0, 0}, 0}));
  CHECK(with_sheet.is_free({{0, ratio(5, 4), 0}, 0}));
  CHECK_FALSE(with_sheet.is_free({{0, ratio(5, 4), 0}, 0}, {{0, 0, 0}, 0}));
}

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
  CHECK(planner(folder, folder.write("long.json", corner("3.9")) + " --ompl RRTConnect --time 0.2").code == 4);
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
