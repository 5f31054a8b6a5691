// SPDX-License-Identifier: Apache-2.0
//
// Poses and motions that turn, judged for OMPL: against slices of free space and against sets.
#include "apps/planner/turning_ompl/turning_validity.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/segments.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/turning_ompl/turning_planning.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;

// An L among turned boxes, all over the place.
Scene random_scene(std::mt19937& random, const std::string& axis, ContactRule contact) {
  Scene scene = scene_of(R"J({"robot": "box(-1,-1/2,0, 1,0,1) + box(-1,-1/2,0, -1/2,1,1/2)", "obstacles": [],
    "start": [0,0,0,0], "goal": [1,1,1,30], "rotation": {"axis": )J" +
                         axis + "}}");
  for (int i = 0; i < 5; ++i) {
    const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 9) - 4) / 2; };
    const Rational3 low{some(), some(), some()};
    const Polyhedron box = make_box(low, {low[0] + 1, low[1] + ratio(1, 2), low[2] + 2});
    scene.obstacles.push_back(i % 2 == 0 ? box : transform(box, AffineMap::rotate({1, 2, 2}, 40)));
    scene.obstacle_names.emplace_back("box");
  }
  scene.contact = contact;
  return scene;
}

TEST_CASE("poses and motions among random boxes are judged as free space says") {
  std::mt19937 random(5);
  std::size_t taken = 0;
  std::size_t touching = 0;
  for (const std::string axis : {R"("z")", "[1, 1, 1]"}) {
    for (const ContactRule contact : {ContactRule::kAllow, ContactRule::kForbid}) {
      const Scene scene = random_scene(random, axis, contact);
      const TurningAxis about = question_of(scene).axis;
      const TurningCollision collision(scene, about);
      for (int i = 0; i < 3; ++i) {
        const Turn turn = ratio(static_cast<long>(random() % 16), 4);
        Scene slice = scene;
        slice.rotation.reset();
        slice.robot = transform(scene.robot, about.rotation(turn));
        const FreeSpace free(free_positions(slice));
        for (int k = 0; k < 30; ++k) {
          const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 25) - 12) / 4; };
          const Rational3 from{some(), some(), some()};
          const Rational3 to{some(), some(), some()};
          const bool is_free = free.is_free(ExactPoint(from));
          CHECK(collision.is_free({from, turn}) == is_free);
          if (!is_free) ++taken;
          if (is_free && free.cells().dimension(free.locate(ExactPoint(from))) < 3) ++touching;
          CHECK(collision.is_free({from, turn}, {to, turn}) == !first_blocked_position(free, from, to).has_value());
        }
        // Corners of the obstacle: contact.
        for (CellId cell = 0; cell < free.cells().size() && free.cells().dimension(cell) == 0; ++cell) {
          const Rational3 vertex = free.vertices(cell).front();
          CHECK(collision.is_free({vertex, turn}) == free.is_free(cell));
        }
      }
    }
  }
  CHECK(taken > 10);
  CHECK(touching + taken > 12);
}

TEST_CASE("a motion that turns is called free only if it is, and is if there is room") {
  std::mt19937 random(8);
  std::size_t valid = 0;
  std::size_t refused = 0;
  const Scene scene = random_scene(random, R"("z")", ContactRule::kAllow);
  const TurningAxis axis = question_of(scene).axis;
  const TurningCollision collision(scene, axis);
  const MotionChecker twin = MotionChecker::of_scene(scene);  // the same, since there are no surfaces
  std::size_t equal = 0;
  const Polyhedron obstacles = unite_all(scene.obstacles);
  for (int i = 0; i < 120; ++i) {
    const auto some = [&]() -> Rational { return Rational(static_cast<long>(random() % 25) - 12) / 4; };
    const Pose from{{some(), some(), some()}, ratio(static_cast<long>(random() % 16), 8)};
    const Pose to{{some(), some(), from.position[2]}, from.turn + ratio(static_cast<long>(random() % 9) - 4, 6)};
    const auto rigid = [&](const Pose& pose) { return RigidPose{pose.position, axis.quaternion(pose.turn)}; };
    CHECK(collision.is_free(from) == (twin.check(rigid(from)).status == MotionVerdict::Status::kFree));
    if (!collision.is_free(from)) continue;
    const bool is_valid = collision.is_free(from, to);
    const MotionVerdict::Status verdict =
        twin.check(RigidMotion(rigid(from), rigid(to), MotionTiming::kSlerp), CheckLimits::for_planners()).status;
    CHECK_FALSE((is_valid && verdict == MotionVerdict::Status::kCollides));
    if (from.turn == to.turn) CHECK(is_valid == (verdict == MotionVerdict::Status::kFree));
    if (is_valid == (verdict == MotionVerdict::Status::kFree)) ++equal;
    bool meets = false;
    for (int k = 0; k <= 8; ++k) {
      const double degrees = axis.degrees_of(from.turn) * (8 - k) / 8 + axis.degrees_of(to.turn) * k / 8;
      AffineMap map = axis.rotation(axis.turn_of_degrees(exact_rational(degrees)));
      for (std::size_t c = 0; c < 3; ++c) {
        map.translation[c] = from.position[c] + ratio(k, 8) * (to.position[c] - from.position[c]);
      }
      meets = meets || !intersect(interior(transform(scene.robot, map)), obstacles).is_empty();
    }
    CHECK_FALSE((is_valid && meets));
    ++(is_valid ? valid : refused);
  }
  CHECK(valid > 15);
  CHECK(refused > 3);
  CHECK(equal + 5 >= valid + refused);
  // On the floor, and along a wall.
  const Scene floor = scene_of(R"J({"robot": "box(-1,-1,0, 1,1,1)", "obstacles": ["box(-9,-9,-1, 9,9,0)",
    "box(2,-9,0, 3,9,4)"], "start": [0,0,0,0], "goal": [0,0,0,90], "rotation": {}})J");
  const TurningCollision on_floor(floor, question_of(floor).axis);
  CHECK(on_floor.is_free({{0, 0, 0}, 0}, {{-1, 2, 0}, 1}));
  CHECK(on_floor.is_free({{1, 0, 0}, 0}, {{1, 3, 0}, 0}));
  CHECK_FALSE(on_floor.is_free({{1, 0, 0}, 0}, {{1, 0, 0}, 1}));  // its corners would go through the wall
  CHECK_FALSE(on_floor.is_free({{0, 0, 0}, 0}, {{0, 0, ratio(-1, 1000000000)}, ratio(1, 2)}));
  // A sheet between the parts of a robot is in its way, though it is on the border of both.
  Scene sheet = scene_of(R"J({"robot": "box(-2,-1,0, 0,1,1) + box(0,-1/2,0, 2,1/2,1)", "obstacles":
    ["box(-9,-9,-1, 9,9,0)", "box(0,-1/4,0, 0,1/4,9)"], "start": [0,0,0,0], "goal": [0,0,0,90], "rotation": {}})J");
  const TurningCollision with_sheet(sheet, question_of(sheet).axis);
  CHECK_FALSE(with_sheet.is_free({{0, 0, 0}, 0}));
  CHECK_FALSE(with_sheet.is_free({{0, 0, 0}, 1}));
  CHECK(with_sheet.is_free({{2, 0, 0}, 0}));
  CHECK(with_sheet.is_free({{0, ratio(5, 4), 0}, 0}));
  CHECK_FALSE(with_sheet.is_free({{0, ratio(5, 4), 0}, 0}, {{0, 0, 0}, 0}));
}

}  // namespace
}  // namespace nef::planner::test
