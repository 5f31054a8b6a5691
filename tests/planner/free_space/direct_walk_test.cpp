// SPDX-License-Identifier: Apache-2.0
//
// What needs no roadmap: segments without the partition of space, cubes that no boundary enters, and ways through them.
#include "apps/planner/free_space/direct_walk.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/search/search.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Rational small_number(std::mt19937& random, int low, int high, int denominator) {
  Rational value(std::uniform_int_distribution<int>(low * denominator, high * denominator)(random), denominator);
  value.canonicalize();
  return value;
}

Rational3 grid_point(std::mt19937& random, int denominator) {
  return {small_number(random, -1, 7, denominator), small_number(random, -1, 7, denominator),
          small_number(random, -1, 7, denominator)};
}

// Boxes, plates and points at small coordinates, so that nearly everything is degenerate.
Polyhedron random_set(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Polyhedron> parts;
  for (int i = 0; i < 6; ++i) {
    const Rational3 low = grid_point(random, 1);
    Rational3 high = low;
    for (Rational& x : high) x += small_number(random, 0, 3, 1);
    parts.push_back(make_box(low, high));
  }
  Polyhedron set = complement(unite_all(parts));
  switch (seed % 3) {
    case 0:
      return set;
    case 1:
      return unite(closure(set), make_segment(grid_point(random, 1), grid_point(random, 2)));
    default: {
      AffineMap shear = AffineMap::identity();
      shear.linear[0][1] = Rational(1, 2);
      shear.linear[1][2] = Rational(-1, 3);
      return transform(set, shear);
    }
  }
}

TEST_CASE("a segment's cells are the same with and without the partition of space, and so says point location") {
  for (unsigned seed = 0; seed < 30; ++seed) {
    INFO("seed " << seed);
    const FreeSpace direct(random_set(seed));
    const FreeSpace by_tree(direct.set());
    by_tree.build_roadmap();
    const CellFilter filter(direct);
    std::mt19937 random(seed + 1000);
    for (int i = 0; i < 60; ++i) {
      const Rational3 a = grid_point(random, 1 + i % 3);
      const Rational3 b = grid_point(random, 1);
      const std::vector<CellOnSegment> mine = cells_along(direct, a, b);
      const std::vector<CellOnSegment> other = cells_along(by_tree, a, b);
      REQUIRE_FALSE(direct.has_roadmap());
      REQUIRE(mine.size() == other.size());
      for (std::size_t k = 0; k < mine.size(); ++k) {
        CHECK(mine[k].cell == other[k].cell);
        CHECK(mine[k].is_point == other[k].is_point);
      }
      CHECK(segment_allowed(direct, filter, a, b) == segment_allowed(by_tree, filter, a, b));
      // The truth about one segment in a few, from a Boolean of the core.
      const bool inside = i % 8 != 0 || a == b || subtract(make_segment(a, b), direct.set()).is_empty();
      if (i % 8 == 0 && a != b) CHECK(segment_allowed(direct, filter, a, b) == inside);
      const std::optional<Rational3> blocked = first_blocked_position(direct, a, b);
      CHECK(blocked.has_value() != segment_allowed(direct, filter, a, b));
      if (blocked) CHECK_FALSE(contains(direct.set(), *blocked));
    }
  }
}

TEST_CASE("cubes of the grid that count as empty hold nothing of the boundary") {
  for (unsigned seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    const Polyhedron set = random_set(seed);
    const EmptyGrid grid(set.complex(), {});
    REQUIRE(grid.size() > 0);
    const Polyhedron surface = boundary(set);
    const Rational half = exact_rational(grid.side()) / 2;
    std::mt19937 random(seed);
    std::size_t empty = 0;
    for (int i = 0; i < 60; ++i) {
      const auto index = static_cast<std::uint32_t>(random() % grid.size());
      if (!grid.is_empty(index)) continue;
      ++empty;
      const Vector3d centre = grid.centre(grid.cube(index));
      Rational3 low;
      Rational3 high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = exact_rational(centre[static_cast<Eigen::Index>(k)]) - half;
        high[k] = exact_rational(centre[static_cast<Eigen::Index>(k)]) + half;
      }
      CHECK(intersect(make_box(low, high), surface).is_empty());
    }
    CHECK(empty > 5);
  }
}

TEST_CASE("there is no grid where there is nothing, or where doubles cannot hold it") {
  CHECK(EmptyGrid(Polyhedron().complex(), {}).size() == 0);
  CHECK(EmptyGrid(make_point({1, 2, 3}).complex(), {}).size() == 0);
  const Rational far(Integer("1000000000000000000000000000000"));
  CHECK(EmptyGrid(make_box({far, 0, 0}, {far + 1, 1, 1}).complex(), {}).size() == 0);
}

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
  int found = 0;
  int joined = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    const FreeSpace free(random_set(seed));
    const CellFilter filter(free);
    std::mt19937 random(seed);
    for (int i = 0; i < 12; ++i) {
      const Rational3 a = grid_point(random, 1 + i % 3);
      const Rational3 b = grid_point(random, 1 + i % 2);
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
  CHECK(joined > 80);
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
