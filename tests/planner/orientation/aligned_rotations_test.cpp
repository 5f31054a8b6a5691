// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/orientation/aligned_rotations.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/orientation/rotations.h"
#include "nef/base/interruption.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::aligned_rotations {
namespace {

const std::set<Integer3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// How many directions of a set a rotation turns into directions of another one.
std::size_t aligned_by(const Quaternion& q, const std::set<Integer3>& of_robot, const std::set<Integer3>& to) {
  const AffineMap turn = map_of({Rational3{}, q});
  return static_cast<std::size_t>(std::count_if(of_robot.begin(), of_robot.end(), [&](const Integer3& direction) {
    const Integer3 turned = primitive(turn(to_rational(direction)));
    return to.count(std::max(turned, opposite(turned))) > 0;
  }));
}

TEST_CASE("The directions of faces are those of planes, each once") {
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, 3});
  CHECK(face_directions({&box, 1}) == kAxes);
  const std::vector<Rational3> corner{
      {0, 0, 0}, {Rational(1, 2), 0, 0}, {0, Rational(1, 3), 0}, {0, 0, Rational(-1, 5)}};
  const std::vector<Polyhedron> both{box, convex_hull(corner)};
  const std::set<Integer3> directions = face_directions(both);
  CHECK(directions.size() == 4);
  CHECK(directions.count({2, 3, -5}) == 1);
  CHECK(face_directions(std::vector<Polyhedron>{complement(box)}) == kAxes);  // nothing at infinity
}

TEST_CASE("Boxes are aligned with boxes at 24 rotations") {
  const std::set<Quaternion> found = ::nef::planner::aligned_rotations(kAxes, kAxes);
  CHECK(found.size() == 24);
  for (const Quaternion& q : found) CHECK(is_in_grid(q, 0));
}

TEST_CASE("Octahedra are aligned with octahedra at the 24 rotations of a cube") {
  const std::set<Integer3> faces{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  const std::set<Quaternion> found = ::nef::planner::aligned_rotations(faces, faces);
  CHECK(found == ::nef::planner::aligned_rotations(kAxes, kAxes));
}

TEST_CASE("Rotations that are not rational are left out") {
  CHECK(::nef::planner::aligned_rotations(kAxes, {{1, 1, 0}, {1, -1, 0}, {0, 0, 1}}).empty());
  CHECK(::nef::planner::aligned_rotations({{1, 0, 0}}, kAxes).empty());  // one direction leaves an angle free
}

TEST_CASE("A turned copy of some directions is aligned by the turn, and each rotation aligns two") {
  std::mt19937 random(20261130);
  for (unsigned round = 0; round < seeds(20); ++round) {
    const auto number = [&](int most) { return std::uniform_int_distribution<int>(-most, most)(random); };
    std::set<Integer3> of_robot;
    while (of_robot.size() < 4) {
      Integer3 v{number(3), number(3), number(3)};
      if (is_zero(v)) continue;
      v = primitive(std::move(v));
      of_robot.insert(std::max(v, opposite(v)));
    }
    Quaternion q{0, 0, 0, 0};
    while (scalar_product(q, q) == 0) q = {number(4), number(4), number(4), number(4)};
    const AffineMap turn = map_of({Rational3{}, q});
    std::set<Integer3> of_obstacles;
    for (const Integer3& v : of_robot) {
      const Integer3 turned = primitive(turn(to_rational(v)));
      of_obstacles.insert(std::max(turned, opposite(turned)));
    }
    of_obstacles.insert(kAxes.begin(), kAxes.end());
    const std::set<Quaternion> found = ::nef::planner::aligned_rotations(of_robot, of_obstacles);
    CHECK(found.count(canonical(q)) == 1);
    for (const Quaternion& rotation : found) {
      CHECK(canonical(rotation) == rotation);
      CHECK(aligned_by(rotation, of_robot, of_obstacles) >= 2);
    }
  }
}

TEST_CASE("A monitor stops the search for aligned rotations") {
  const std::atomic<bool> stop{true};
  CHECK_THROWS_AS(::nef::planner::aligned_rotations(kAxes, kAxes, Monitor().stopped_by(&stop)), Interrupted);
}

}  // namespace
}  // namespace nef::planner::test::aligned_rotations
