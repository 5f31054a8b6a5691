// SPDX-License-Identifier: Apache-2.0
#include "tests/planner/scene_table.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace nef::planner::test {
namespace {

bool passes_through(const ExactPath& path, const Rational3& point) {
  return std::find(path.points.begin(), path.points.end(), point) != path.points.end();
}

}  // namespace

const std::vector<Expected>& scene_table() {
  using Status = Answer::Status;
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
      {"s7_one_box", path, 3, 3, {3}, path, 1, {}, std::sqrt(17) + 3 + std::sqrt(10)},
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

void check_closed(const Expected& expected, const Scene& scene, const AffineMap& map, bool lengths) {
  INFO(expected.file);
  const Problem problem(scene);
  const FreeSpace& free = problem.free_space();
  const Answer answer = problem.solve();
  CHECK(answer.status == expected.closed);
  CHECK(component_dimensions(free) == expected.components);
  // None of these scenes has a box, so there is an outside, and one only.
  CHECK(std::count_if(free.components().begin(), free.components().end(),
                      [](const Component& component) { return !component.bounded; }) == 1);
  if (expected.closed != Answer::Status::kPath || answer.status != Answer::Status::kPath) return;
  CHECK(answer.thinness->piece == expected.piece);
  CHECK(answer.thinness->junction == expected.junction);
  CHECK(independent_complaint(scene, free.set(), *answer.path, true) == "");
  CHECK(answer.path->points.front() == *scene.start);
  CHECK(answer.path->points.back() == *scene.goal);
  for (const Rational3& point : expected.forced) CHECK(passes_through(*answer.path, map(point)));
  if (lengths && expected.length > 0) CHECK(answer.path->length == Approx(expected.length).epsilon(1e-9));
  PathOptions roomy;
  roomy.roomy = true;
  const Answer best = problem.solve(roomy);
  REQUIRE(best.path.has_value());
  CHECK(best.path->thinness.piece == expected.piece);
  CHECK(best.path->thinness.junction == expected.junction);
}

void check_open(const Expected& expected, Scene scene) {
  INFO(expected.file);
  scene.contact = ContactRule::kForbid;
  const Problem problem(scene);
  const Answer answer = problem.solve();
  CHECK(answer.status == expected.open);
  if (expected.open_components > 0) CHECK(problem.free_space().components().size() == expected.open_components);
  if (answer.path) CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, true) == "");
  CHECK(problem.free_space().passages().empty());
}

}  // namespace nef::planner::test
