// SPDX-License-Identifier: Apache-2.0
//
// Random scenes of boxes on a small grid against a decision that shares nothing with the planner.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "tests/planner/grid_arrangement.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

struct RandomScene {
  std::vector<GridBox> robot;
  std::vector<GridBox> obstacles;
  std::vector<GridBox> taken;  // per pair: obstacle + -robot
};

RandomScene random_scene(std::mt19937& random) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  RandomScene scene;
  const Cell size{number(1, 2), number(1, 2), number(1, 2)};
  scene.robot.push_back({{0, 0, 0}, size});
  if (number(0, 2) == 0) scene.robot.push_back({{0, 0, size[2]}, {1, 1, size[2] + 1}});
  const int count = number(3, 9);
  for (int i = 0; i < count; ++i) {
    GridBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = number(0, 4);
      box.high[k] = std::min(6, box.low[k] + number(1, 5));
    }
    scene.obstacles.push_back(box);
  }
  // Now and then a closed shell, so that something is enclosed.
  if (number(0, 1) == 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int at : {-1, 6}) {
        GridBox wall{{-1, -1, -1}, {7, 7, 7}};
        wall.low[k] = at;
        wall.high[k] = at + 1;
        scene.obstacles.push_back(wall);
      }
    }
  }
  for (const GridBox& o : scene.obstacles) {
    for (const GridBox& r : scene.robot) {
      GridBox box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = o.low[k] - r.high[k];
        box.high[k] = o.high[k] - r.low[k];
      }
      scene.taken.push_back(box);
    }
  }
  return scene;
}

Polyhedron solid(const std::vector<GridBox>& boxes) {
  std::vector<Polyhedron> parts;
  for (const GridBox& box : boxes) {
    parts.push_back(make_box({box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}));
  }
  return unite_all(parts);
}

Rational3 point_of_cell(const Cell& c) {
  Rational3 point{Rational(c[0], 2), Rational(c[1], 2), Rational(c[2], 2)};
  for (Rational& value : point) value.canonicalize();
  return point;
}

struct GridScene {
  RandomScene grid;
  Scene scene;
};

GridScene make_scene(std::mt19937& random, bool forbid) {
  GridScene result{random_scene(random), {}};
  result.scene.robot = solid(result.grid.robot);
  for (const GridBox& box : result.grid.obstacles) result.scene.obstacles.push_back(solid({box}));
  result.scene.obstacle_names.assign(result.scene.obstacles.size(), "box");
  result.scene.contact = forbid ? ContactRule::kForbid : ContactRule::kAllow;
  return result;
}

void check_scene(unsigned seed, bool forbid) {
  INFO("seed " << seed << (forbid ? ", contact forbidden" : ""));
  std::mt19937 random(seed);
  const GridScene made = make_scene(random, forbid);
  const Problem problem(made.scene);
  const FreeSpace& free = problem.free_space();
  const Arrangement truth(made.grid.taken, forbid);
  int count = 0;
  std::array<std::vector<int>, 4> components;
  for (int k = 1; k < 4; ++k) components[static_cast<std::size_t>(k)] = truth.components(k, count);
  components[0] = truth.components(0, count);
  const std::vector<Cell> special = compare_all(free, truth, components[0], count);

  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const auto some_cell = [&](bool prefer_special) {
    if (!prefer_special || special.empty()) return Cell{number(-4, 13), number(-4, 13), number(-4, 13)};
    return special[static_cast<std::size_t>(number(0, static_cast<int>(special.size()) - 1))];
  };
  for (int pair = 0; pair < 6; ++pair) {
    const Cell a = some_cell(pair % 2 == 1);
    const Cell b = some_cell(pair % 3 == 2);
    if (!truth.is_free(a) || !truth.is_free(b)) continue;
    PathOptions quick;
    quick.thorough = false;
    const Answer answer = problem.solve(point_of_cell(a), point_of_cell(b), quick);
    const bool reachable = components[0][Arrangement::index(a)] == components[0][Arrangement::index(b)];
    CHECK((answer.status == Answer::Status::kPath) == reachable);
    if (!answer.path) continue;
    int thinnest = 3;
    for (; thinnest > 0; --thinnest) {
      const std::vector<int>& thick = components[static_cast<std::size_t>(thinnest)];
      const int at = thick[Arrangement::index(a)];
      if (at >= 0 && at == thick[Arrangement::index(b)]) break;
    }
    CHECK(answer.thinness->piece == thinnest);
    int junction = 3;
    while (junction > 0 && !truth.joined_by(junction, a, b)) --junction;
    CHECK(answer.thinness->junction == junction);
    CHECK(answer.path->points.front() == point_of_cell(a));
    CHECK(answer.path->points.back() == point_of_cell(b));
    if (pair < 2) CHECK(independent_complaint(made.scene, free.set(), *answer.path, !forbid) == "");
  }
}

TEST_CASE("random boxes on a grid, contact allowed, against breadth-first search") {
  for (unsigned seed = 0; seed < seeds(100); ++seed) check_scene(seed, false);
}

TEST_CASE("random boxes on a grid, contact forbidden, against breadth-first search") {
  for (unsigned seed = 0; seed < seeds(33); ++seed) check_scene(seed + 1000000, true);
}

}  // namespace
}  // namespace nef::planner::test
