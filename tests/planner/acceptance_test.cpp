// SPDX-License-Identifier: Apache-2.0
//
// Scenes whose answers are known by hand: solvable or not with contact allowed and forbidden, T and J, components,
// way-points that every path must have, shortest lengths; each as it is, turned obliquely, and changed in ways that
// must not matter.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/minkowski/minkowski.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

using Status = Answer::Status;

struct Expected {
  std::string file;
  Status closed;
  int piece;  // T and J if solvable
  int junction;
  std::vector<int> components;  // dimensions, with contact allowed
  Status open;
  std::size_t open_components;    // 0: not stated
  std::vector<Rational3> forced;  // way-points of the shortest path
  double length;                  // of the shortest path; 0: not stated
};

const std::vector<Expected>& table() {
  const Status path = Status::kPath;
  const Status no = Status::kInfeasible;
  const Status bad = Status::kInvalidStart;
  static const std::vector<Expected> value{
      {"s1_tight_hole", path, 1, 0, {3, 3}, no, 3, {{3, 1, 1}, {5, 1, 1}}, 2 + 3 * std::sqrt(2)},
      {"s1_wider", path, 3, 3, {3, 3}, path, 2, {}, 0},
      {"s1_narrower", no, 0, 0, {3, 3, 3}, no, 0, {}, 0},
      {"s2_tight_slot", path, 2, 1, {3, 3}, no, 3, {}, std::sqrt(22 + 4 * std::sqrt(17))},
      {"s4_rooms_at_an_edge", path, 3, 1, {3, 3}, no, 3, {{0, 0, Rational(3, 2)}}, std::sqrt(21)},
      {"s5_closed_box", no, 0, 0, {3, 3}, no, 0, {}, 0},
      {"s7_one_box", path, 3, 3, {3}, path, 0, {}, std::sqrt(17) + 3 + std::sqrt(10)},
      {"s8_fence", path, 3, 3, {3}, bad, 0, {{3, 1, 2}, {5, 1, 2}}, 2 + 4 * std::sqrt(2)},
      {"s9_gate_and_rail", path, 1, 0, {3, 3}, no, 3, {{0, 3, 0}, {0, 6, 0}}, 0},
      {"s10_t_slot", path, 1, 0, {3}, bad, 0, {{0, 10, 0}}, 0},
      {"s10_capped", no, 0, 0, {3, 1}, bad, 0, {}, 0},
      {"s12_two_abutting_boxes", no, 0, 0, {3, 3, 3}, no, 0, {}, 0},
      {"s12_point_robot", no, 0, 0, {3, 3, 3}, no, 0, {}, 0},
      {"s14_two_ways", path, 3, 3, {3, 3}, path, 2, {{3, 1, 1}, {5, 1, 1}}, 2 + 3 * std::sqrt(2)},
      {"peg", path, 1, 0, {3}, bad, 0, {}, 5},
  };
  return value;
}

bool passes_through(const ExactPath& path, const Rational3& point) {
  return std::find(path.points.begin(), path.points.end(), point) != path.points.end();
}

// Every column of the table for a scene that is the table's under an isometry (or any linear map, if lengths are not
// kept).
void check(const Expected& expected, const Scene& scene, const AffineMap& map, bool lengths, bool sweep) {
  INFO(expected.file);
  const Problem problem(scene);
  const Answer answer = problem.solve();
  CHECK(answer.status == expected.closed);
  CHECK(component_dimensions(problem.free_space()) == expected.components);
  if (expected.closed != Status::kPath || answer.status != Status::kPath) return;
  CHECK(answer.thinness->piece == expected.piece);
  CHECK(answer.thinness->junction == expected.junction);
  CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, sweep) == "");
  CHECK(answer.path->points.front() == *scene.start);
  CHECK(answer.path->points.back() == *scene.goal);
  for (const Rational3& point : expected.forced) CHECK(passes_through(*answer.path, map(point)));
  if (lengths && expected.length > 0) CHECK(answer.path->length == Approx(expected.length).epsilon(1e-9));
}

TEST_CASE("scenes with known answers, contact allowed") {
  for (const Expected& expected : table()) {
    check(expected, load(expected.file), AffineMap::identity(), true, true);
  }
}

TEST_CASE("scenes with known answers, contact forbidden") {
  for (const Expected& expected : table()) {
    INFO(expected.file);
    Scene scene = load(expected.file);
    scene.contact = ContactRule::kForbid;
    const Problem problem(scene);
    const Answer answer = problem.solve();
    CHECK(answer.status == expected.open);
    if (expected.open_components > 0) CHECK(problem.free_space().components().size() == expected.open_components);
    if (answer.path) CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, false) == "");
    CHECK(problem.free_space().passages().empty());
  }
}

TEST_CASE("scenes with known answers, turned by an oblique rational rotation") {
  for (const Expected& expected : table()) {
    const AffineMap map = oblique_rotation();
    check(expected, mapped(load(expected.file), map), map, true, false);
  }
}

TEST_CASE("T, J and components survive any invertible linear map") {
  AffineMap map = AffineMap::identity();
  map.linear[0][1] = Rational(1, 2);
  map.linear[1][2] = Rational(-2, 3);
  map.linear[2][0] = Rational(1, 5);
  map.translation = {Rational(7, 3), -11, Rational(1, 9)};
  for (const Expected& expected : table()) {
    Expected without_forced = expected;
    without_forced.forced.clear();  // another shortest path may be found
    check(without_forced, mapped(load(expected.file), map), map, false, false);
  }
}

TEST_CASE("start and goal exchanged, robot moved against its reference point, mirrored: the same answers") {
  for (const Expected& expected : table()) {
    if (expected.closed == Status::kInvalidStart) continue;
    INFO(expected.file);
    const Scene scene = load(expected.file);

    Scene swapped = scene;
    std::swap(swapped.start, swapped.goal);
    check(expected, swapped, AffineMap::identity(), true, false);

    const Rational3 by{Rational(1, 3), -2, Rational(5, 7)};
    Scene moved = scene;
    moved.robot = transform(scene.robot, AffineMap::translate(by));
    const AffineMap back = AffineMap::translate({-by[0], -by[1], -by[2]});
    moved.start = back(*scene.start);
    moved.goal = back(*scene.goal);
    check(expected, moved, back, true, false);

    check(expected, mapped(scene, AffineMap::scale({-1, -1, -1})), AffineMap::scale({-1, -1, -1}), true, false);
  }
}

TEST_CASE("obstacles and robot exchanged mirror the configuration space") {
  // (O + -R) = -(R + -O): F(O, R) = -F(R, O) for a bounded obstacle.
  const Scene scene = load("s10_t_slot");
  Scene exchanged = scene;
  exchanged.robot = scene.obstacles[0];
  exchanged.obstacles = {scene.robot};
  CHECK(equal(free_positions(scene), minkowski::negate(free_positions(exchanged))));
}

TEST_CASE("a solid split into touching pieces makes no passage") {
  Scene scene = load("s1_tight_hole");
  Scene split = scene;
  split.obstacles.clear();
  const Rational3 low{-20, -20, -20};
  for (const Polyhedron& obstacle : scene.obstacles) {
    split.obstacles.push_back(intersect(obstacle, make_box(low, {20, Rational(4, 3), 20})));
    split.obstacles.push_back(intersect(obstacle, make_box({-20, Rational(4, 3), -20}, {20, 20, 20})));
  }
  split.obstacle_names.assign(4, "half");
  CHECK(equal(free_positions(scene), free_positions(split)));
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
  CHECK(passage.rooms.size() == 2);
  CHECK(problem.solve().path->passages == std::vector<std::uint32_t>{0});
  // The free space is known in full: two boxes, the segment, and the outside.
  const Polyhedron rooms = unite(make_box({0, 0, 0}, {3, 2, 2}), make_box({5, 0, 0}, {8, 2, 2}));
  const Polyhedron inside = unite(rooms, make_segment({3, 1, 1}, {5, 1, 1}));
  const Polyhedron outside = complement(interior(make_box({-2, -2, -2}, {10, 4, 4})));
  CHECK(equal(free.set(), unite(inside, outside)));
}

TEST_CASE("S2: the plate is a facet, and its infimum is approached though its way-point is irrational") {
  const Problem problem(load("s2_tight_slot"));
  REQUIRE(problem.free_space().passages().size() == 1);
  CHECK(problem.free_space().passages()[0].dimension == 2);
}

TEST_CASE("S10 with a cap: the start component is a segment, and moves within it are found") {
  const Problem problem(load("s10_capped"));
  CHECK(problem.solve().status == Answer::Status::kInfeasible);
  const Answer within = problem.solve({0, 0, 0}, {0, 8, 0}, {});
  REQUIRE(within.status == Answer::Status::kPath);
  CHECK(within.path->length == 8);
  CHECK(within.thinness->piece == 1);
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

TEST_CASE("the published tunnel: wide for side 0.6, by contact only for side 1") {
  for (const bool wide : {true, false}) {
    Scene scene = load(wide ? "ztunnel_06" : "ztunnel_1");
    const Problem problem(scene);
    const Answer answer = problem.solve();
    REQUIRE(answer.status == Answer::Status::kPath);
    CHECK((answer.thinness->piece == 3) == wide);
    CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, true) == "");
    scene.contact = ContactRule::kForbid;
    CHECK((Problem(scene).solve().status == Answer::Status::kPath) == wide);
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
