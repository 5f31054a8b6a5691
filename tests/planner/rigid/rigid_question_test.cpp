// SPDX-License-Identifier: Apache-2.0
//
// Scenes whose robot turns freely.
#include "apps/planner/rigid/rigid_question.h"

#include <catch2/catch.hpp>

#include "apps/planner/path/question.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::rigid_question {
namespace {

constexpr const char* kShapes = R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(3,0,0, 4,9,9)"])J";
constexpr const char* kEnds =
    R"J(, "rotation": "SO(3)", "start": {"position": [0, "1/3", 0.5], "quaternion": [2, 0, 0, 0]},
    "goal": {"position": [8, 0, 0], "quaternion": ["1/2", "1/2", 0, 0]}})J";

TEST_CASE("A scene says how a robot that turns freely is turned at start and goal", "[rigid]") {
  const Scene scene = scene_of(std::string(kShapes) + kEnds);
  CHECK(scene.turns_freely);
  CHECK_FALSE(scene.rotation);
  CHECK_FALSE(scene.only_translates());
  const RigidQuestion question = rigid_question_of(scene);
  CHECK(question.start.position == Rational3{0, Rational(1, 3), Rational(1, 2)});
  CHECK(question.start.quaternion == Quaternion{2, 0, 0, 0});
  CHECK(question.goal.quaternion == Quaternion{Rational(1, 2), Rational(1, 2), 0, 0});
  CHECK_THROWS_WITH(Problem(scene), Catch::Contains("for translations only"));
  CHECK_THROWS_AS(rigid_question_of(scene_of(std::string(kShapes) + "}")), InputError);
  CHECK_THROWS_WITH(rigid_question_of(scene_of(std::string(kShapes) + R"J(, "rotation": "SO(3)"})J")),
                    Catch::Contains("needs a start and a goal"));
}

TEST_CASE("A path of positions alone is certified if the robot turns freely", "[rigid]") {
  const Folder folder;
  const std::string scene = folder.write("scene.json", std::string(kShapes) + kEnds);
  const std::string path = folder.write("straight.path", "0 0 0\n1.5 0 0\n");
  CHECK(planner(folder, scene + " --path " + path).code == 0);
  CHECK(planner(folder, scene + " --start 1,2,3,4 --path " + path).code == 2);
  CHECK(planner(folder, scene + " --start 1,2,3,0,0,0,0 --path " + path).code == 2);
}

}  // namespace
}  // namespace nef::planner::test::rigid_question
