// SPDX-License-Identifier: Apache-2.0
//
// The known scenes turned obliquely, sheared, and changed in ways that must not matter: all answers stay.
#include <algorithm>
#include <catch2/catch.hpp>

#include "apps/minkowski/minkowski.h"
#include "nef/export/to_mesh.h"
#include "tests/planner/scene_table.h"

namespace nef::planner::test {
namespace {

void check_both(const Expected& expected, const Scene& scene, const AffineMap& map, bool lengths = true) {
  check_closed(expected, scene, map, lengths);
  check_open(expected, scene);
}

TEST_CASE("scenes with known answers, turned by an oblique rational rotation") {
  const AffineMap map = oblique_rotation();
  for (const Expected& expected : scene_table()) check_both(expected, mapped(load(expected.file), map), map);
}

TEST_CASE("T, J and components survive any invertible linear map") {
  AffineMap map = AffineMap::identity();
  map.linear[0][1] = Rational(1, 2);
  map.linear[1][2] = Rational(-2, 3);
  map.linear[2][0] = Rational(1, 5);
  map.translation = {Rational(7, 3), -11, Rational(1, 9)};
  for (const Expected& expected : scene_table()) {
    Expected without_forced = expected;
    without_forced.forced.clear();  // another path may be the shortest now
    check_both(without_forced, mapped(load(expected.file), map), map, false);
  }
}

TEST_CASE("the same answers for start and goal exchanged") {
  for (const Expected& expected : scene_table()) {
    Expected swapped = expected;
    if (swapped.open == Answer::Status::kInvalidStart) {
      // The peg and its kin start in contact; their goals are free of it, but for the cap's.
      swapped.open = expected.file == "s8_fence" ? Answer::Status::kInvalidStart : Answer::Status::kInvalidGoal;
    }
    Scene scene = load(expected.file);
    std::swap(scene.start, scene.goal);
    check_both(swapped, scene, AffineMap::identity());
  }
}

TEST_CASE("the same answers for another reference point of the robot") {
  const Rational3 by{Rational(1, 3), -2, Rational(5, 7)};
  const AffineMap back = AffineMap::translate({-by[0], -by[1], -by[2]});
  for (const Expected& expected : scene_table()) {
    Scene scene = load(expected.file);
    scene.robot = transform(scene.robot, AffineMap::translate(by));
    scene.start = back(*scene.start);
    scene.goal = back(*scene.goal);
    check_both(expected, scene, back);
  }
}

TEST_CASE("the same answers in a mirror") {
  const AffineMap mirror = AffineMap::scale({-1, -1, -1});
  for (const Expected& expected : scene_table()) check_both(expected, mapped(load(expected.file), mirror), mirror);
}

TEST_CASE("the order of obstacles does not matter, nor does cutting them into touching pieces") {
  // Cut at no coordinate of any scene, and at one that holds walls of many.
  for (const Rational& at : {Rational(4, 3), Rational(1)}) {
    for (const Expected& expected : scene_table()) {
      INFO(expected.file);
      const Scene scene = load(expected.file);
      Scene split = scene;
      split.obstacles.clear();
      split.obstacle_names.clear();
      for (const Polyhedron& obstacle : scene.obstacles) {
        const Polyhedron left = make_halfspace(0, 1, 0, -at, true);
        for (const Polyhedron& half : {left, closure(complement(left))}) {
          split.obstacles.insert(split.obstacles.begin(), closure(interior(intersect(obstacle, half))));
          split.obstacle_names.emplace_back("half");
        }
      }
      CHECK(equal(free_positions(scene), free_positions(split)));
      Scene reversed = scene;
      std::reverse(reversed.obstacles.begin(), reversed.obstacles.end());
      reversed.contact = ContactRule::kForbid;
      split.contact = ContactRule::kForbid;
      CHECK(equal(free_positions(reversed), free_positions(split)));
    }
  }
}

TEST_CASE("obstacles and robot exchanged mirror the configuration space") {
  // (O + -R) = -(R + -O), so F(O, R) = -F(R, O) for bounded obstacles.
  for (const Expected& expected : scene_table()) {
    INFO(expected.file);
    for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
      Scene scene = load(expected.file);
      scene.contact = contact;
      Scene exchanged = scene;
      exchanged.robot = unite_all(scene.obstacles);
      exchanged.obstacles = {scene.robot};
      exchanged.obstacle_names = {"robot"};
      CHECK(equal(free_positions(scene), minkowski::negate(free_positions(exchanged))));
    }
  }
}

// The same set from its triangles, with vertices, faces and first corners in another order.
Polyhedron shuffled(const Polyhedron& set) {
  const Mesh mesh = to_mesh(set).mesh;
  Mesh result;
  result.vertices.assign(mesh.vertices.rbegin(), mesh.vertices.rend());
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::size_t f = mesh.face_count(); f-- > 0;) {
    const std::span<const std::uint32_t> corners = mesh.face(f);
    REQUIRE(corners.size() == 3);
    result.push_face(std::array<std::uint32_t, 3>{last - corners[1], last - corners[2], last - corners[0]});
  }
  return from_mesh(result);
}

TEST_CASE("triangulations of obstacles and robot do not matter") {
  for (const Expected& expected : scene_table()) {
    if (expected.file == "s12_point_robot") continue;  // no mesh is a point
    INFO(expected.file);
    const Scene scene = load(expected.file);
    Scene triangulated = scene;
    triangulated.robot = shuffled(scene.robot);
    for (Polyhedron& obstacle : triangulated.obstacles) obstacle = shuffled(obstacle);
    CHECK(equal(free_positions(scene), free_positions(triangulated)));
  }
}

}  // namespace
}  // namespace nef::planner::test
