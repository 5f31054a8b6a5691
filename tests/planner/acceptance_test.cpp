// SPDX-License-Identifier: Apache-2.0
//
// Scenes whose answers are known by hand: solvable or not with contact allowed and forbidden, T and J, components,
// way-points that every path must have, shortest lengths, and what is special in each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/minkowski/minkowski.h"
#include "tests/planner/scene_table.h"

namespace nef::planner::test {
namespace {

using Status = Answer::Status;

TEST_CASE("scenes with known answers, contact allowed") {
  for (const Expected& expected : scene_table()) {
    check_closed(expected, load(expected.file), AffineMap::identity(), true);
  }
}

TEST_CASE("scenes with known answers, contact forbidden") {
  for (const Expected& expected : scene_table()) check_open(expected, load(expected.file));
}

TEST_CASE("the tight hole of S1 is listed with its exact geometry and what it joins") {
  const Problem problem(load("s1_tight_hole"));
  const FreeSpace& free = problem.free_space();
  REQUIRE(free.passages().size() == 1);
  const TightPassage& passage = free.passages()[0];
  CHECK(passage.dimension == 1);
  REQUIRE(passage.cells.size() == 1);
  std::vector<Rational3> ends = free.vertices(passage.cells[0]);
  std::sort(ends.begin(), ends.end());
  CHECK(ends == std::vector<Rational3>{{3, 1, 1}, {5, 1, 1}});
  CHECK(passage.mouths.size() == 2);
  CHECK(passage.volumes.size() == 2);
  CHECK(problem.solve().path->passages == std::vector<std::uint32_t>{0});
  // The free space is known in full: two boxes, the segment, and the outside.
  const Polyhedron rooms = unite(make_box({0, 0, 0}, {3, 2, 2}), make_box({5, 0, 0}, {8, 2, 2}));
  const Polyhedron inside = unite(rooms, make_segment({3, 1, 1}, {5, 1, 1}));
  const Polyhedron outside = complement(interior(make_box({-2, -2, -2}, {10, 4, 4})));
  CHECK(equal(free.set(), unite(inside, outside)));
}

TEST_CASE("S2: the tight slot is the plate y = 1 between the rooms") {
  const Problem problem(load("s2_tight_slot"));
  const FreeSpace& free = problem.free_space();
  REQUIRE(free.passages().size() == 1);
  CHECK(free.passages()[0].dimension == 2);
  const Polyhedron plate = make_box({3, 1, 0}, {5, 1, 2});
  const Polyhedron rooms = unite(make_box({0, 0, 0}, {3, 2, 2}), make_box({5, 0, 0}, {8, 2, 2}));
  const Polyhedron tight = subtract(free.set(), closure(interior(free.set())));
  CHECK(equal(tight, subtract(plate, rooms)));
}

TEST_CASE("S4: no passage, but the rooms meet in the edge x = y = 0 only") {
  const Problem problem(load("s4_rooms_at_an_edge"));
  CHECK(problem.free_space().passages().empty());
  const Polyhedron edge = make_segment({0, 0, 0}, {0, 0, 3});
  const FreeSpace without(subtract(problem.free_space().set(), edge));
  CHECK_FALSE(find_path(without, {-2, -1, 1}, {1, 2, 2}).has_value());
  CHECK(equal(intersect(make_box({-3, -3, 0}, {0, 0, 3}), problem.free_space().set()),
              unite(edge, make_box({-3, -3, 0}, {0, 0, 3}))));
}

TEST_CASE("S7: one component, the complement of an open cube") {
  const Problem problem(load("s7_one_box"));
  CHECK(equal(problem.free_space().set(), complement(interior(make_box({-1, -1, -1}, {2, 2, 2})))));
}

TEST_CASE("S5: the inner component is a cube, the outer one unbounded") {
  const Problem problem(load("s5_closed_box"));
  const Polyhedron inside = make_box({0, 0, 0}, {2, 2, 2});
  CHECK(equal(intersect(problem.free_space().set(), make_box({-1, -1, -1}, {3, 3, 3})), inside));
}

TEST_CASE("S1 with a hole a billionth wider: no passage is tight") {
  CHECK(Problem(load("s1_wider")).free_space().passages().empty());
}

TEST_CASE("S10: disassembly, the only free direction is +y, up to the exit") {
  const Problem problem(load("s10_t_slot"));
  for (const Rational3& step : std::vector<Rational3>{{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    const Rational3 near{step[0] / 1000, step[1] / 1000, step[2] / 1000};
    CHECK(problem.solve({0, 0, 0}, near, {}).status == Answer::Status::kInvalidGoal);
  }
  REQUIRE(problem.free_space().passages().size() == 1);
  const Polyhedron tight = subtract(problem.free_space().set(), closure(interior(problem.free_space().set())));
  CHECK(equal(tight, subtract(make_segment({0, 0, 0}, {0, 10, 0}), make_point({0, 10, 0}))));
}

TEST_CASE("S10 with a cap: the start component is a segment, and moves within it are found") {
  const Problem problem(load("s10_capped"));
  CHECK(problem.solve().status == Answer::Status::kInfeasible);
  const Answer within = problem.solve({0, 0, 0}, {0, 8, 0}, {});
  REQUIRE(within.status == Answer::Status::kPath);
  CHECK(within.path->length == 8);
  CHECK(within.thinness->piece == 1);
}

TEST_CASE("S14: the shortest path is the thin one, T and J tell the best, the path its own") {
  const Answer answer = Problem(load("s14_two_ways")).solve();
  REQUIRE(answer.path.has_value());
  CHECK(answer.path->thinness.piece == 1);
  CHECK(answer.path->thinness.junction == 0);
  CHECK(answer.thinness->piece == 3);
  CHECK(answer.thinness->junction == 3);
}

TEST_CASE("S14: minimal dimension and preference choose the door") {
  const Problem problem(load("s14_two_ways"));
  PathOptions thick;
  thick.min_dimension = 3;
  const Answer by_door = problem.solve(thick);
  REQUIRE(by_door.path.has_value());
  CHECK(by_door.path->length == Approx(12.8158).epsilon(1e-5));
  CHECK(by_door.path->thinness.piece == 3);
  PathOptions roomy;
  roomy.roomy = true;
  const Answer best = problem.solve(roomy);
  REQUIRE(best.path.has_value());
  CHECK(best.path->thinness.piece == 3);
  CHECK(best.path->thinness.junction == 3);
}

TEST_CASE("S9: deleting the forced segment's cell disconnects") {
  const Problem problem(load("s9_gate_and_rail"));
  const Polyhedron without = subtract(problem.free_space().set(), make_segment({0, 4, 0}, {0, 5, 0}));
  const FreeSpace free(without);
  CHECK_FALSE(find_path(free, {3, Rational(1, 2), 4}, {-2, 8, Rational(9, 2)}).has_value());
}

// The tunnel's box as a wall around it, so that the scene can be turned. The robot is a cube about the origin.
Scene walled(Scene scene) {
  const std::array<Rational3, 2> robot = *bounding_box(scene.robot);
  std::array<Rational3, 2> inner = *scene.box;
  for (std::size_t i = 0; i < 3; ++i) {
    inner[0][i] += robot[0][i];
    inner[1][i] += robot[1][i];
  }
  const Polyhedron outer = make_box({-20, -20, -20}, {20, 20, 20});
  scene.obstacles.push_back(subtract(outer, interior(make_box(inner[0], inner[1]))));
  scene.obstacle_names.emplace_back("wall");
  scene.box.reset();
  return scene;
}

// Of side 1 the cube has no play across the slab that it is in: plates x = -5/2, z = 0 and y = -9/4 (T = 2), which
// meet in edges where two directions are tight at once (J = 1).
TEST_CASE("the published tunnel: wide for side 0.6, by contact only for side 1") {
  for (const bool wide : {true, false}) {
    const Scene scene = load(wide ? "ztunnel_06" : "ztunnel_1");
    const int thin = wide ? 3 : 2;
    const Expected expected{wide ? "tunnel, side 0.6" : "tunnel, side 1",
                            Answer::Status::kPath,
                            thin,
                            wide ? 3 : 1,
                            {3, 3},
                            wide ? Answer::Status::kPath : Answer::Status::kInfeasible,
                            wide ? 2U : 3U,
                            {},
                            0};
    const Problem problem(scene);
    const Answer answer = problem.solve();
    REQUIRE(answer.status == Answer::Status::kPath);
    CHECK(component_dimensions(problem.free_space()) == std::vector<int>{3});
    CHECK(answer.thinness->piece == thin);
    CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, true) == "");
    check_closed(expected, walled(scene), AffineMap::identity(), false);
    check_open(expected, walled(scene));
    check_closed(expected, mapped(walled(scene), oblique_rotation()), oblique_rotation(), false);
    check_open(expected, mapped(walled(scene), oblique_rotation()));
    if (wide) continue;
    REQUIRE(problem.free_space().passages().size() == 1);
    const Polyhedron plates[] = {make_box({Rational(-5, 2), Rational(3, 2), 0}, {Rational(-5, 2), Rational(7, 4), 6}),
                                 make_box({Rational(-5, 2), Rational(3, 2), 0}, {Rational(3, 2), Rational(7, 4), 0}),
                                 make_box({Rational(5, 4), Rational(-9, 4), 0}, {Rational(3, 2), Rational(7, 4), 0}),
                                 make_box({Rational(5, 4), Rational(-9, 4), -6}, {Rational(3, 2), Rational(-9, 4), 0})};
    const Polyhedron room = closure(interior(problem.free_space().set()));
    CHECK(equal(subtract(problem.free_space().set(), room), subtract(unite_all(plates), room)));
  }
}

TEST_CASE("the published peg leaves its hole along (0,-1,0) only") {
  const Problem problem(load("peg"));
  for (const Rational3& step : std::vector<Rational3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    const Rational3 near{step[0] / 1000, step[1] / 1000, step[2] / 1000};
    CHECK(problem.solve(near, {0, -5, 0}, {}).status == Answer::Status::kInvalidStart);
  }
  CHECK(problem.solve({0, Rational(-1, 1000), 0}, {0, -5, 0}, {}).status == Answer::Status::kPath);
}

TEST_CASE("an invalid start names the obstacle, its cell and a point of the overlap") {
  const Scene scene = load("s1_tight_hole");
  const Problem problem(scene);
  const Answer answer = problem.solve({Rational(7, 2), 1, Rational(1, 2)}, {7, 1, 1}, {});
  REQUIRE(answer.status == Answer::Status::kInvalidStart);
  REQUIRE(answer.collision.has_value());
  CHECK(answer.collision->obstacle == 1);
  CHECK(contains(scene.obstacles[1], answer.collision->point));
  const Polyhedron robot = transform(interior(scene.robot), AffineMap::translate({Rational(7, 2), 1, Rational(1, 2)}));
  CHECK(contains(robot, answer.collision->point));
  CHECK(problem.solve({1, 1, 1}, {Rational(7, 2), 1, Rational(1, 2)}, {}).status == Answer::Status::kInvalidGoal);
}

TEST_CASE("raw and clearance paths are paths too, and clearance keeps off the walls") {
  for (const char* name : {"s1_tight_hole", "s2_tight_slot", "s8_fence", "s9_gate_and_rail", "s14_two_ways"}) {
    INFO(name);
    const Scene scene = load(name);
    const Problem problem(scene);
    PathOptions raw;
    raw.raw = true;
    PathOptions clear;
    clear.clearance = true;
    for (const PathOptions& options : {raw, clear}) {
      const Answer answer = problem.solve(options);
      REQUIRE(answer.path.has_value());
      CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, false) == "");
    }
  }
  PathOptions clear;
  clear.clearance = true;
  clear.min_dimension = 3;
  const Problem problem(load("s14_two_ways"));
  const Answer answer = problem.solve(clear);
  REQUIRE(answer.path.has_value());
  for (std::size_t i = 1; i + 1 < answer.path->points.size(); ++i) {
    const CellId cell = problem.free_space().locate(ExactPoint(answer.path->points[i]));
    CHECK(problem.free_space().cells().dimension(cell) == 3);
  }
}

}  // namespace
}  // namespace nef::planner::test
