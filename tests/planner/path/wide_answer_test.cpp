// SPDX-License-Identifier: Apache-2.0
//
// Paths among meshes without looking for tight passages: against the whole free space, which is made from convex cells.
#include "apps/planner/path/wide_answer.h"

#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "apps/planner/path/question.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/program/exact_json.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/minkowski_shapes.h"

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

TEST_CASE("the free space of a wide answer is the closure of the inside of the whole one") {
  Scene scene = mushroom_scene();
  for (const bool boxed : {false, true}) {
    if (boxed) scene.box = {Rational3{-3, -2, -1}, Rational3{3, 2, 3}};
    REQUIRE(may_have_wide_answer(scene));
    const std::optional<WideAnswer> wide = wide_answer(scene, {});
    REQUIRE(wide.has_value());
    const Problem problem(scene);
    CHECK(equal(wide->free->set(), regularize(problem.free_space().set())));
    CHECK(independent_complaint(scene, problem.free_space().set(), *wide->answer.path, !boxed) == "");
    CHECK(wide->answer.path->thinness.piece == 3);
    CHECK(wide->answer.thinness->junction == 3);
    CHECK(wide->answer.path->points.front() == *scene.start);
    CHECK(wide->answer.path->points.back() == *scene.goal);
  }
}

TEST_CASE("where only a tight passage leads, and where it does not matter, there is no wide answer") {
  Scene scene = mushroom_scene();
  const Rational width(1, 5);
  // Around the start a box with a hole that the robot's own box would just pass, and the robot at one place only.
  add(scene, subtract(make_box({-3, -1, -1}, {-1, 1, 1}),
                      interior(make_box({-Rational(5, 2), -Rational(1, 2), -Rational(1, 2)},
                                        {-Rational(3, 2), Rational(1, 2), Rational(1, 2)}))));
  CHECK_FALSE(wide_answer(scene, {}).has_value());  // walled in
  scene.obstacles.back() =
      subtract(scene.obstacles.back(), interior(make_box({-Rational(7, 4), 0, 0}, {0, width, width})));
  CHECK_FALSE(wide_answer(scene, {}).has_value());
  CHECK(Problem(scene).solve().status == Answer::Status::kPath);
  Scene in_collision = mushroom_scene();
  in_collision.start = Rational3{0, 0, Rational(1, 4)};
  CHECK_FALSE(wide_answer(in_collision, {}).has_value());
  Scene forbidding = mushroom_scene();
  forbidding.contact = ContactRule::kForbid;
  CHECK_FALSE(may_have_wide_answer(forbidding));
  CHECK_FALSE(may_have_wide_answer(load("s1_tight_hole")));
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
  CHECK_THAT(report["messages"][0].get<std::string>(), Catch::Contains("tight passages were not looked for"));
  const nlohmann::json all = nlohmann::json::parse(planner(folder, scene + " --json --tight").out);
  CHECK(all["tight"].is_array());
  CHECK(all["messages"].empty());
}

// A sheet from (0, 0) to (12, 12) with a height at each whole x and y, as a file; squares that `holes` takes are left
// out.
std::string sheet_text(unsigned seed, const std::function<bool(int, int)>& holes) {
  constexpr int kSide = 12;
  std::mt19937 random(seed);
  std::string vertices;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      vertices += std::to_string(x) + ' ' + std::to_string(y) + " 0." + std::to_string(random() % 9) + '\n';
    }
  }
  std::string faces;
  int count = 0;
  const auto face = [&](int a, int b, int c) {
    faces += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    ++count;
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (holes(x, y)) continue;
      const int at = y * (kSide + 1) + x;
      face(at, at + 1, at + kSide + 2);
      face(at, at + kSide + 2, at + kSide + 1);
    }
  }
  return "OFF\n" + std::to_string((kSide + 1) * (kSide + 1)) + ' ' + std::to_string(count) + " 0\n" + vertices + faces;
}

TEST_CASE("past surfaces, the parts that are near the path give the path that all of them give") {
  const Folder folder;
  const auto no_hole = [](int, int) { return false; };
  const std::string way = folder.file("way.json");
  const auto corner = [](int x, int y) { return x > 8 && y > 5 && y < 9; };
  for (unsigned seed = 0; seed < 6; ++seed) {
    INFO("seed " << seed);
    static_cast<void>(folder.write("sheet.off", seed % 2 == 0 ? sheet_text(seed, no_hole) : sheet_text(seed, corner)));
    const std::string scene = folder.write("scene.json", R"J({"robot": "hull([0,0,0], [1/2,0,0], [0,1/2,0], [0,0,1/2])",
      "obstacles": ["sheet.off", "box(3,3,2, 5,5,3)"], "start": [7,6,-3], "goal": [4,)J" +
                                                             std::to_string(seed + 3) + ",4]}");
    const nlohmann::json some = nlohmann::json::parse(planner(folder, scene + " --json -o " + way).out);
    const nlohmann::json all = nlohmann::json::parse(planner(folder, scene + " --json --tight").out);
    REQUIRE(some["status"] == "path");
    CHECK(some["tight"].is_null());
    CHECK(all["tight"].is_array());
    CHECK(some["thinnest_piece"] == all["thinnest_piece"]);
    CHECK(some["thinnest_junction"] == all["thinnest_junction"]);
    CHECK(some["length"].get<double>() == Approx(all["length"].get<double>()).epsilon(0.01));
    CHECK(planner(folder, scene + " --path " + way).code == 0);
  }
}

TEST_CASE("where surfaces leave no way, or a tight one only, all of them are asked") {
  const Folder folder;
  const auto hole = [](int x, int y) { return x == 6 && y == 6; };
  static_cast<void>(folder.write("sheet.off", sheet_text(1, hole)));
  const auto scene = [&](const std::string& width) {
    return folder.write("scene.json", R"J({"robot": "box(0,0,0, )J" + width + R"J(,1,1)", "obstacles": ["sheet.off"],
      "box": [[0,0,-5],[11,11,5]], "start": [2,2,-4], "goal": [3,2,4]})J");
  };
  const nlohmann::json through = nlohmann::json::parse(planner(folder, scene("1") + " --json").out);
  CHECK(through["status"] == "path");
  CHECK(through["tight"].is_array());
  CHECK(through["thinnest_piece"].get<int>() < 3);
  CHECK(planner(folder, scene("1.001") + " --json").code == 1);
}

}  // namespace
}  // namespace nef::planner::test
