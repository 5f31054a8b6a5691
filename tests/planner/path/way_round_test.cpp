// SPDX-License-Identifier: Apache-2.0
//
// Paths that must not touch are as short as those that may, but for a little. The shortest path that may touch is known
// by hand, or is that of the same scene with contact allowed, whose free space is the closure of the other one.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/planner/path/question.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Answer answer_of(Scene scene, ContactRule contact, bool roomy) {
  scene.contact = contact;
  const Problem problem(scene);
  PathOptions options;
  options.roomy = roomy;
  Answer answer = problem.solve(options);
  if (answer.path) CHECK(independent_complaint(scene, problem.free_space().set(), *answer.path, false) == "");
  return answer;
}

// Eight boxes of thirds in a room, and a robot whose way is mostly blocked; nothing fits exactly, since the robot is a
// seventh wide.
Scene random_boxes(std::mt19937& random) {
  const auto upto = [&](int n) { return static_cast<long>(random() % static_cast<unsigned>(n)); };
  Scene scene;
  scene.name = "boxes";
  const Rational side(1, 7);
  scene.robot = make_box({0, 0, 0}, {side, side, side});
  for (int i = 0; i < 8; ++i) {
    Rational3 low{ratio(3 + upto(12), 3), ratio(upto(9) - 1, 3), ratio(upto(9) - 1, 3)};
    Rational3 high;
    for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + ratio(1 + upto(k == 0 ? 2 : 6), 3);
    scene.obstacles.push_back(make_box(low, high));
    scene.obstacle_names.push_back("box " + std::to_string(i));
  }
  scene.box = {Rational3{0, 0, 0}, Rational3{6, 2, 2}};
  scene.start = Rational3{ratio(1, 5), ratio(4, 5), ratio(3, 5)};
  scene.goal = Rational3{ratio(29, 5), ratio(7, 5), ratio(4, 5)};
  return scene;
}

TEST_CASE("over a fence that may not be touched: the known length, but for a little") {
  // The robot rests a tenth above the floor, and the fence is 2 high: over (3,1,2) and (5,1,2).
  const Scene scene = scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(-9,-9,-1, 19,19,0)",
      "box(4,-9,0, 5,19,2)"], "start": [1,1,"1/10"], "goal": [7,1,"1/10"]})J");
  const double touching = 2 + 2 * std::hypot(2, 1.9);
  const Answer allowed = answer_of(scene, ContactRule::kAllow, false);
  CHECK(allowed.path->length == Approx(touching).epsilon(1e-9));
  const Answer forbidden = answer_of(scene, ContactRule::kForbid, false);
  CHECK(forbidden.path->length > touching);
  CHECK(forbidden.path->length < touching * 1.0001);
  CHECK(forbidden.path->thinness.junction == 3);
  const Answer roomy = answer_of(scene, ContactRule::kAllow, true);
  CHECK(roomy.path->length < touching * 1.0001);
  CHECK(roomy.path->thinness.junction == 3);
}

TEST_CASE("the side of an obstacle is not chosen by the walls of the box, which may be touched") {
  // Way-points on the sides of the box are free, those on the obstacles are not. The shortest way round all is below.
  const Scene scene = scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(4,-7,-1, 9/2,3,2)",
      "box(8,-2,-1, 9,-1,2)", "box(-6,-1,-1, -5,4,2)", "box(-5,-1,-1, 1,5,2)", "box(-7,4,-1, -13/2,8,2)"],
      "box": [[-11,-11,0], [11,11,0]], "start": [-10,0,0], "goal": [10,4,0]})J");
  const double touching = std::hypot(3, 2) + 8 + std::hypot(2, 5) + std::hypot(7, 1);
  CHECK(answer_of(scene, ContactRule::kAllow, false).path->length == Approx(touching).epsilon(1e-6));
  CHECK(answer_of(scene, ContactRule::kForbid, false).path->length < touching * 1.0001);
  CHECK(answer_of(scene, ContactRule::kAllow, true).path->length < touching * 1.0001);
}

TEST_CASE("among boxes, paths that must not touch are about as short as those that may") {
  std::mt19937 random(38);
  double worst = 1;
  unsigned compared = 0;
  for (unsigned i = 0; i < seeds(12); ++i) {
    const Scene scene = random_boxes(random);
    const Answer allowed = answer_of(scene, ContactRule::kAllow, false);
    if (!allowed.path) continue;
    for (const bool roomy : {false, true}) {
      const Answer apart = answer_of(scene, roomy ? ContactRule::kAllow : ContactRule::kForbid, roomy);
      REQUIRE(apart.path.has_value());
      CHECK(apart.path->length > allowed.path->length * 0.98);  // both are local optima
      worst = std::max(worst, apart.path->length / allowed.path->length);
      ++compared;
    }
  }
  INFO("compared " << compared << ", worst " << worst);
  CHECK(compared > 0);
  CHECK(worst < 1.05);
}

}  // namespace
}  // namespace nef::planner::test
