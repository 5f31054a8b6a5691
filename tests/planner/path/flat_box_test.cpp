// SPDX-License-Identifier: Apache-2.0
//
// Free space without any inside, since the box is flat: parts of its boundary need not be free, and paths keep off them
// with every option.
#include <catch2/catch.hpp>

#include "apps/planner/path/question.h"

namespace nef::planner::test {
namespace {

// A box, a flat obstacle and a flat box, with the axes exchanged in turn.
Scene flat_scene(std::size_t turn) {
  const auto turned = [turn](const Rational3& p) {
    Rational3 q;
    for (std::size_t k = 0; k < 3; ++k) q[(k + turn) % 3] = p[k];
    return q;
  };
  Scene scene;
  scene.name = "flat box";
  scene.robot = make_box(turned({-1, 0, 0}), turned({0, 1, 1}));
  scene.obstacles = {make_box(turned({0, 4, 3}), turned({2, 4, 4}))};
  scene.obstacle_names = {"wall"};
  scene.box = {turned({0, -1, -1}), turned({0, 8, 8})};
  scene.contact = ContactRule::kForbid;
  scene.start = turned({0, 3, -1});
  scene.goal = turned({0, Rational(7, 2), Rational(23, 4)});
  return scene;
}

TEST_CASE("paths in a flat box that must not touch, with every option") {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    for (const ContactRule contact : {ContactRule::kForbid, ContactRule::kAllow}) {
      Scene scene = flat_scene(turn);
      scene.contact = contact;
      const Problem problem(scene);
      for (unsigned code = 0; code < 16; ++code) {
        INFO("turn " << turn << ", options " << code);
        PathOptions options;
        options.clearance = (code & 1U) != 0;
        options.raw = (code & 2U) != 0;
        options.roomy = (code & 4U) != 0;
        options.thorough = (code & 8U) != 0;
        const Answer answer = problem.solve(options);
        REQUIRE(answer.status == Answer::Status::kPath);
        CHECK(answer.path->points.front() == *scene.start);
        CHECK(answer.path->points.back() == *scene.goal);
        for (std::size_t i = 0; i + 1 < answer.path->points.size(); ++i) {
          // Along all of the segment no point of the robot is in the obstacle.
          for (int k = 0; k <= 16; ++k) {
            Rational3 at;
            for (std::size_t c = 0; c < 3; ++c) {
              at[c] = answer.path->points[i][c] +
                      Rational(k, 16) * (answer.path->points[i + 1][c] - answer.path->points[i][c]);
            }
            CHECK_FALSE(find_collision(scene, at).has_value());
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
