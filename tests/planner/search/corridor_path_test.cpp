// SPDX-License-Identifier: Apache-2.0
//
// Corridors through cubes that no boundary enters, and roadmaps of parts of free space where there are none.
#include <catch2/catch.hpp>
#include <random>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/path.h"
#include "apps/planner/search/search.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// Many small boxes, and a wall across with one hole.
Scene large_scene(const Rational3& hole_low, const Rational3& hole_high) {
  std::mt19937 random(5);
  Scene scene;
  scene.robot = unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({0, 0, 0}, {2, 1, Rational(1, 2)}));
  for (int i = 0; i < 90; ++i) {
    const Rational3 low{small_number(random, 1, 36, 4), small_number(random, 1, 18, 4), small_number(random, 1, 18, 4)};
    scene.obstacles.push_back(make_box(low, {low[0] + 1, low[1] + Rational(3, 4), low[2] + Rational(1, 2)}));
  }
  const Polyhedron room = subtract(make_box({-4, -4, -4}, {44, 24, 24}), make_box({-3, -3, -3}, {43, 23, 23}));
  scene.obstacles.push_back(room);
  scene.obstacles.push_back(subtract(make_box({20, -4, -4}, {21, 24, 24}), make_box(hole_low, hole_high)));
  scene.obstacle_names.assign(scene.obstacles.size(), "");
  return scene;
}

// True if each segment lies in the set, by Booleans of the core.
bool lies_in(const std::vector<Rational3>& way, const Polyhedron& set) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Polyhedron segment = way[i] == way[i + 1] ? make_point(way[i]) : make_segment(way[i], way[i + 1]);
    if (!subtract(segment, set).is_empty()) return false;
  }
  return true;
}

TEST_CASE("a way through roadmaps of parts of free space, in random sets with many a tight passage") {
  unsigned found = 0;
  unsigned joined = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(24); ++seed) {
    INFO("seed " << seed);
    const FreeSpace free(degenerate_set(seed));
    const CellFilter filter(free);
    std::mt19937 random(seed);
    for (int i = 0; i < 12; ++i) {
      const Rational3 a = point_near_degenerate_set(random, 1 + i % 3);
      const Rational3 b = point_near_degenerate_set(random, 1 + i % 2);
      const CellId from = free.locate(ExactPoint(a));
      const CellId to = free.locate(ExactPoint(b));
      if (!free.is_free(from) || !free.is_free(to)) continue;
      const std::optional<std::vector<Rational3>> way = corridor_path(free, filter, 0, a, b, {});
      if (free.component(from) != free.component(to)) {
        CHECK_FALSE(way.has_value());
        continue;
      }
      ++joined;
      if (!way) continue;
      ++found;
      CHECK(way->front() == a);
      CHECK(way->back() == b);
      CHECK(lies_in(*way, free.set()));
    }
    CHECK_FALSE(free.has_roadmap());
  }
  CHECK(joined > nef::test::fewer(80));
  CHECK(found * 10 > joined * 9);
}

TEST_CASE("where free space is wide, or tight in few places, a path needs no roadmap of all of it") {
  const Rational3 start{-2, -2, -2};
  const Rational3 goal{40, 20, 20};
  const FreeSpace wide(free_positions(large_scene({19, 8, 8}, {22, 14, 14})));
  REQUIRE(wide.cells().size() >= 2000);
  for (const bool roomy : {false, true}) {
    PathOptions options;
    options.roomy = roomy;
    const std::optional<ExactPath> path = find_path(wide, start, goal, options);
    REQUIRE(path.has_value());
    CHECK_FALSE(wide.has_roadmap());
    CHECK(path->points.front() == start);
    CHECK(path->points.back() == goal);
    CHECK(path->length < 62);  // as the crow flies 52.2, by way of the hole's middle 53
    CHECK(independent_complaint(large_scene({19, 8, 8}, {22, 14, 14}), wide.set(), *path, false) == "");
  }
  const Rational3 low{19, 8, 8};
  const FreeSpace tight(free_positions(large_scene(low, {22, 9, 9})));
  const std::optional<ExactPath> path = find_path(tight, start, goal);
  REQUIRE(path.has_value());
  CHECK_FALSE(tight.has_roadmap());
  CHECK(path->thinness.piece == 1);
  CHECK(independent_complaint(large_scene(low, {22, 9, 9}), tight.set(), *path, false) == "");
  // From within the passage, and back.
  const Rational3 inside{Rational(39, 2), 8, 8};
  REQUIRE(tight.passage_of(tight.locate(ExactPoint(inside))).has_value());
  for (const auto& [a, b] : {std::pair(inside, goal), std::pair(start, inside), std::pair(goal, start)}) {
    const std::optional<ExactPath> part = find_path(tight, a, b);
    REQUIRE(part.has_value());
    CHECK(part->points.front() == a);
    CHECK(part->points.back() == b);
    CHECK(lies_in(part->points, tight.set()));
  }
  PathOptions thick;
  thick.min_dimension = 2;
  CHECK_FALSE(find_path(tight, start, goal, thick).has_value());
  CHECK(tight.has_roadmap());  // a proof by all of it
  const FreeSpace closed(free_positions(large_scene(low, {22, 9, Rational(8) + Rational(99, 100)})));
  CHECK_FALSE(find_path(closed, start, goal).has_value());
  CHECK_FALSE(closed.has_roadmap());
}

TEST_CASE("from a room with a tight door to another one, among many boxes, without a roadmap of it all") {
  Scene scene = large_scene({19, 8, 8}, {22, 14, 14});
  const Rational half(1, 2);
  // Walls of thickness 1/2 around a cube, with a door of 1 x 1 at a corner.
  const auto room = [&](const Rational3& low, int size, const Rational3& door) {
    const auto plus = [&low](const Rational& by) { return Rational3{low[0] + by, low[1] + by, low[2] + by}; };
    const Polyhedron walls = subtract(make_box(low, plus(size)), make_box(plus(half), plus(size - half)));
    return closure(subtract(walls, make_box(door, {door[0] + 1, door[1] + 1, door[2] + 1})));
  };
  scene.obstacles.push_back(room({-3, -3, -3}, 4, {Rational(1, 4), -2, -2}));
  scene.obstacles.push_back(room({38, 18, 18}, 5, {Rational(151, 4), 20, 20}));
  scene.obstacle_names.assign(scene.obstacles.size(), "");
  const Rational3 start{-2, -2, -2};
  const Rational3 goal{40, 20, 20};
  const FreeSpace free(free_positions(scene));
  REQUIRE(free.cells().size() >= 2000);
  const CellFilter filter(free);
  CHECK(corridor_path(free, filter, 0, start, goal, {}).has_value());
  for (const auto& [a, b] : {std::pair(start, goal), std::pair(goal, start)}) {
    const std::optional<ExactPath> path = find_path(free, a, b);
    REQUIRE(path.has_value());
    CHECK(path->points.front() == a);
    CHECK(path->points.back() == b);
    CHECK(path->passages.size() == 2);
    CHECK(path->thinness.piece == 1);
    CHECK(lies_in(path->points, free.set()));
    CHECK(path->length < 62);
  }
  CHECK_FALSE(free.has_roadmap());
  // Doors a hair narrower.
  scene.robot = unite(scene.robot, make_box({0, 0, 0}, {1, Rational(1001, 1000), 1}));
  const FreeSpace shut(free_positions(scene));
  CHECK_FALSE(find_path(shut, start, goal).has_value());
  CHECK_FALSE(shut.has_roadmap());
}

}  // namespace
}  // namespace nef::planner::test
