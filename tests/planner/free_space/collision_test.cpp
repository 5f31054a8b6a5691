// SPDX-License-Identifier: Apache-2.0
//
// Robots and obstacles of mixed dimension: what hits what, against the free space, which is computed in another way.
#include <catch2/catch.hpp>
#include <random>

#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// A box of random size on the grid, flat in some directions.
Polyhedron random_box(std::mt19937& random, int span) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Rational3 low;
  Rational3 high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = number(-span, span);
    high[i] = low[i] + number(0, 2);
  }
  return make_box(low, high);
}

Scene random_sets(std::mt19937& random) {
  Scene scene;
  scene.robot = unite(random_box(random, 1), random_box(random, 1));
  for (int i = 0; i < 3; ++i) {
    scene.obstacles.push_back(unite(random_box(random, 3), random_box(random, 3)));
    scene.obstacle_names.push_back("set " + std::to_string(i));
  }
  if (random() % 3 == 0) scene.box = {Rational3{-4, -4, -4}, Rational3{4, 4, 4}};
  return scene;
}

// The overlap that is named is one: a point of the obstacle's cell and of the robot.
void check_collision(const Scene& scene, const Collision& collision, const Rational3& position) {
  if (collision.outside_box) {
    REQUIRE(scene.box.has_value());
    CHECK_FALSE(contains(make_box((*scene.box)[0], (*scene.box)[1]), position));
    return;
  }
  const Polyhedron& obstacle = scene.obstacles.at(collision.obstacle);
  CHECK(contains(obstacle, collision.point));
  CHECK(contains(transform(scene.robot, AffineMap::translate(position)), collision.point));
  const Location cell = locate(obstacle, collision.point);
  CHECK(cell.kind == collision.cell.kind);
  CHECK(cell.index == collision.cell.index);
}

TEST_CASE("a position is free or hits something, for robots and obstacles of mixed dimension") {
  std::size_t hits = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(60); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Scene scene = random_sets(random);
    for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
      scene.contact = contact;
      const FreeSpace free(free_positions(scene));
      for (int i = 0; i < 12; ++i) {
        Rational3 position;
        for (Rational& x : position) {
          x = Rational(static_cast<int>(random() % 19) - 9, 2);
          x.canonicalize();
        }
        const std::optional<Collision> collision = find_collision(scene, position);
        CHECK(collision.has_value() != free.is_free(ExactPoint(position)));
        if (!collision) continue;
        ++hits;
        check_collision(scene, *collision, position);
      }
    }
  }
  CHECK(hits > nef::test::fewer(200));
}

TEST_CASE("a whisker of a solid robot must not enter an obstacle, and is named if it does") {
  const Folder folder;
  const std::string file = folder.write("whisker.json", R"J({
    "robot": "box(0,0,0, 1,1,1) + segment(1,0.5,0.5, 2,0.5,0.5)", "obstacles": ["box(3,0,0, 4,1,1)"],
    "start": [1.5, 0, 0], "goal": [0, 0, 5]})J");
  for (const char* how : {"", " --ompl RRT --time 0.1"}) {
    const Run run = planner(folder, file + how);
    CHECK(run.code == 3);
    CHECK_THAT(run.out, Catch::Contains("invalid_start: overlaps obstacle 0"));
  }
  CHECK(planner(folder, file + " --start 1,0,0").code == 0);  // touches
}

}  // namespace
}  // namespace nef::planner::test
