// SPDX-License-Identifier: Apache-2.0
//
// Collisions at sizes where products of doubles overflow or vanish, against the same at an ordinary size.
#include "tests/support/numbers/magnitudes.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/segments.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/turning/turning_collision.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test::magnitudes {
namespace {

using nef::test::kExponents;
using nef::test::kFewExponents;
using nef::test::power_of_two;
using nef::test::scaled;

class Numbers {
 public:
  Rational between(double low, double high) {
    return exact_rational(std::uniform_real_distribution<double>(low, high)(random_));
  }
  Rational3 point(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

 private:
  std::mt19937_64 random_{7};
};

Scene scaled(const Scene& scene, const Rational& factor) {
  Scene result = scene;
  result.robot = scaled(scene.robot, factor);
  for (Polyhedron& obstacle : result.obstacles) obstacle = scaled(obstacle, factor);
  return result;
}

RigidPose scaled(const RigidPose& pose, const Rational& factor) {
  return {scaled(pose.position, factor), pose.quaternion};
}

// Oblique, so that no coordinate is a small number.
Scene window() {
  return mapped(scene_of(R"J({"robot": "hull(-1,0,0, 1,0,0, 0,1,0, 0,1/3,1)",
      "obstacles": ["box(2,-5,-5, 3,5,5) - box(1,-2,-1, 4,2,1)", "hull(-4,-3,-3, -2,1,2, -3,2,-1, -5,4,3)"]})J"),
                oblique_rotation());
}

TEST_CASE("planner at any magnitude: segments are free as at an ordinary size", "[bounds]") {
  const Polyhedron set = free_positions(window());
  const FreeSpace free(set);
  Numbers random;
  std::vector<std::array<Rational3, 2>> segments;
  std::vector<bool> expected;
  int count = 0;
  for (int i = 0; i < 120; ++i) {
    segments.push_back({random.point(6), random.point(6)});
    expected.push_back(segment_allowed(free, CellFilter(free), segments.back()[0], segments.back()[1]));
    count += expected.back() ? 1 : 0;
  }
  CHECK(count > 20);
  CHECK(count < 180);
  for (const long exponent : kExponents) {
    const Rational factor = power_of_two(exponent);
    const FreeSpace large(scaled(set, factor));
    const CellFilter all(large);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      INFO("segment " << i << " times 2^" << exponent);
      CHECK(segment_allowed(large, all, scaled(segments[i][0], factor), scaled(segments[i][1], factor)) == expected[i]);
    }
  }
}

TEST_CASE("planner at any magnitude: poses and motions that turn freely", "[bounds]") {
  using Status = MotionVerdict::Status;
  const Scene scene = window();
  const MotionChecker checker = MotionChecker::of_scene(scene);
  Numbers random;
  const auto pose = [&] {
    return RigidPose{random.point(4), {random.between(0.1, 1), random.between(-1, 1), random.between(-1, 1), 0}};
  };
  struct Case {
    RigidPose from;
    RigidPose to;
    bool collides;
    Status motion;
  };
  CheckLimits limits;
  limits.depth = 2;
  std::vector<Case> cases;
  int collisions = 0;
  for (int i = 0; i < 12; ++i) {
    Case c{pose(), pose(), false, Status::kFree};
    c.collides = checker.check(c.from).status == Status::kCollides;
    c.motion = checker.check(RigidMotion(c.from, c.to), limits).status;
    collisions += c.collides ? 1 : 0;
    cases.push_back(c);
  }
  CHECK(collisions > 2);
  CHECK(collisions < 11);
  std::size_t first = 0;
  for (const long exponent : kFewExponents) {
    const Rational factor = power_of_two(exponent);
    const MotionChecker large = MotionChecker::of_scene(scaled(scene, factor));
    first = 1 - first;  // every other case each time
    for (std::size_t i = first; i < cases.size(); i += 2 * (5 / nef::test::fewer(5))) {
      INFO("case " << i << " times 2^" << exponent);
      const RigidPose from = scaled(cases[i].from, factor);
      CHECK((large.check(from).status == Status::kCollides) == cases[i].collides);
      const Status motion = large.check(RigidMotion(from, scaled(cases[i].to, factor)), limits).status;
      // Where doubles tell less, a motion is undecided.
      if (motion != Status::kUndecided && cases[i].motion != Status::kUndecided) CHECK(motion == cases[i].motion);
    }
  }
}

TEST_CASE("planner at any magnitude: poses and motions that turn about an axis", "[bounds]") {
  const Scene scene = window();
  const TurningAxis axis({1, 2, 4});
  const TurningCollision collision(scene, axis);
  Numbers random;
  struct Case {
    Pose from;
    Pose to;
    bool free;
    bool free_way;
    bool free_turn;
  };
  std::vector<Case> cases;
  int count = 0;
  for (int i = 0; i < 12; ++i) {
    Case c{{random.point(4), random.between(0, 4)}, {random.point(4), 0}, false, false, false};
    c.to.turn = c.from.turn;
    c.free = collision.is_free(c.from);
    c.free_way = collision.is_free(c.from, c.to);
    count += c.free ? 1 : 0;
    Pose turned = c.to;
    turned.turn += ratio(1, 3);
    c.free_turn = collision.is_free(c.from, turned);
    cases.push_back(c);
  }
  CHECK(count > 2);
  CHECK(count < 11);
  std::size_t first = 0;
  for (const long exponent : kFewExponents) {
    const Rational factor = power_of_two(exponent);
    const TurningCollision large(scaled(scene, factor), axis);
    first = 1 - first;  // every other case each time
    for (std::size_t i = first; i < cases.size(); i += 2 * (5 / nef::test::fewer(5))) {
      INFO("case " << i << " times 2^" << exponent);
      const Pose from{scaled(cases[i].from.position, factor), cases[i].from.turn};
      const Pose to{scaled(cases[i].to.position, factor), cases[i].to.turn};
      CHECK(large.is_free(from) == cases[i].free);
      CHECK(large.is_free(from, to) == cases[i].free_way);
      Pose turned = to;
      turned.turn += ratio(1, 3);
      if (!cases[i].free_turn) CHECK_FALSE(large.is_free(from, turned, 1));
    }
  }
}

}  // namespace
}  // namespace nef::planner::test::magnitudes
