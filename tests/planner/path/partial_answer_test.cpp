// SPDX-License-Identifier: Apache-2.0
//
// Paths among solid meshes without looking for tight passages: against the whole free space.
#include "apps/planner/path/partial_answer.h"

#include <catch2/catch.hpp>

#include "apps/planner/path/question.h"
#include "apps/program/reports/exact_json.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_writer.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/minkowski_shapes.h"

namespace nef::planner::test {
namespace {

void add(Scene& scene, const Polyhedron& obstacle) {
  scene.obstacles.push_back(obstacle);
  scene.obstacle_names.emplace_back("obstacle");
}

// A tetrahedron beside a mushroom, and a plate above.
Scene mushroom_scene() {
  Scene scene;
  scene.name = "mushroom";
  scene.robot = convex_hull(std::vector<Rational3>{
      {0, 0, 0}, {Rational(1, 5), 0, 0}, {0, Rational(1, 5), 0}, {0, Rational(1, 10), Rational(1, 5)}});
  add(scene, from_mesh(nef::test::mushroom()));
  add(scene, make_box({-1, -1, 2}, {1, 1, Rational(9, 4)}));
  scene.start = Rational3{-2, 0, Rational(1, 4)};
  scene.goal = Rational3{2, 0, Rational(1, 4)};
  return scene;
}

TEST_CASE("the free space of an interior answer is the closure of the inside of the whole one") {
  Scene scene = mushroom_scene();
  for (const bool boxed : {false, true}) {
    if (boxed) scene.box = {Rational3{-3, -2, -1}, Rational3{3, 2, 3}};
    const std::optional<Answer> part = partial_answer(scene, {});
    REQUIRE(part.has_value());
    const Problem problem(scene);
    CHECK(equal(interior_positions(scene), regularize(problem.free_space().set())));
    CHECK(independent_complaint(scene, problem.free_space().set(), *part->path, !boxed) == "");
    CHECK(part->path->thinness.piece == 3);
    CHECK(part->thinness->junction == 3);
    CHECK(part->path->points.front() == *scene.start);
    CHECK(part->path->points.back() == *scene.goal);
  }
}

TEST_CASE("where only a tight passage leads, and where it does not matter, there is no interior answer") {
  Scene scene = mushroom_scene();
  const Rational width(1, 5);
  // Around the start a box with a hole that the robot's own box would just pass, and the robot at one place only.
  add(scene, subtract(make_box({-3, -1, -1}, {-1, 1, 1}),
                      interior(make_box({-Rational(5, 2), -Rational(1, 2), -Rational(1, 2)},
                                        {-Rational(3, 2), Rational(1, 2), Rational(1, 2)}))));
  CHECK_FALSE(interior_answer(scene, {}).has_value());  // walled in
  scene.obstacles.back() =
      subtract(scene.obstacles.back(), interior(make_box({-Rational(7, 4), 0, 0}, {0, width, width})));
  CHECK_FALSE(interior_answer(scene, {}).has_value());
  CHECK(Problem(scene).solve().status == Answer::Status::kPath);
  Scene in_collision = mushroom_scene();
  in_collision.start = Rational3{0, 0, Rational(1, 4)};
  CHECK_FALSE(interior_answer(in_collision, {}).has_value());
  Scene forbidding = mushroom_scene();
  forbidding.contact = ContactRule::kForbid;
  CHECK_FALSE(partial_answer(forbidding, {}).has_value());
  CHECK_FALSE(partial_answer(load("s1_tight_hole"), {}).has_value());
}

TEST_CASE("the command says that tight passages were not looked for, and lists them if it is told to") {
  const Folder folder;
  write_mesh(folder.file("mushroom.off"), nef::test::mushroom());
  const std::string scene = folder.write("scene.json", R"J({"robot": "box(0,0,0, 1/5,1/5,1/5)", "obstacles":
    ["mushroom.off"], "start": [-2,0,0], "goal": [2,0,0]})J");
  const nlohmann::json report = nlohmann::json::parse(planner(folder, scene + " --json").out);
  CHECK(report["status"] == "path");
  CHECK(report["tight"].is_null());
  CHECK(report["components"].is_null());
  CHECK_THAT(report["messages"][0].get<std::string>(), Catch::Contains("tight passages were not searched"));
  const nlohmann::json all = nlohmann::json::parse(planner(folder, scene + " --json --tight").out);
  CHECK(all["tight"].is_array());
  CHECK(all["messages"].empty());
}

}  // namespace
}  // namespace nef::planner::test
