// SPDX-License-Identifier: Apache-2.0
//
// Linear programs, and motions that are fitted between obstacles.
#include "apps/planner/rigid_search/motion_fit.h"

#include <catch2/catch.hpp>

#include "apps/planner/rigid_search/linear_program.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::motion_fit {
namespace {

TEST_CASE("Small linear programs", "[rigid]") {
  // Of x + y with x <= 2, x + 2 y <= 4.
  Eigen::MatrixXd a(2, 2);
  a << 1, 0, 1, 2;
  const Eigen::VectorXd x = maximize(a, Eigen::Vector2d(2, 4), Eigen::Vector2d(1, 1));
  CHECK(x[0] == Approx(2));
  CHECK(x[1] == Approx(1));
  CHECK(maximize(a, Eigen::Vector2d(2, 4), Eigen::Vector2d(-1, -1)).norm() == Approx(0));
  CHECK(maximize(a, Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)).norm() == Approx(0));
}

TEST_CASE("A quarter turn round a corner of a corridor is fitted, and certified", "[rigid]") {
  const Scene scene = scene_of(R"J({"robot": "box(-3/2,-1/2,-1/2, 3/2,1/2,1/2)",
      "obstacles": ["box(-9,-9,-1, 9,9,1) - box(-8,-2,-1, 0,0,1) - box(-2,-2,-1, 0,8,1)"],
      "box": [[-9, -9, 0], [9, 9, 0]]})J");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const MotionFit fit(checker);
  REQUIRE(fit.is_worthwhile());
  std::vector<Quaternion> rotations;
  std::vector<Vector3d> positions;
  for (int i = 0; i <= 8; ++i) {
    rotations.push_back({1, 0, 0, ratio(i, 8)});
    positions.emplace_back(-2.5 + i * 0.1875, -1 + i * 0.1875, 0);  // straight through the corner
  }
  const std::vector<Vector3d> before = positions;
  const double gap = fit.fit(rotations, positions, 1, 0.1);
  CHECK(gap > 0.01);
  CHECK((positions[4] - before[4]).norm() > 0.1);
  for (std::size_t i = 1; i < rotations.size(); ++i) {
    CHECK(positions[i][2] == Approx(0).margin(1e-12));  // the box
    const auto pose = [&](std::size_t k) {
      return RigidPose{{exact_rational(positions[k][0]), exact_rational(positions[k][1]), 0}, rotations[k]};
    };
    CHECK(checker.check(RigidMotion(pose(i - 1), pose(i), MotionTiming::kSlerp)).status ==
          MotionVerdict::Status::kFree);
  }
  // Where nothing is near, nothing moves.
  std::vector<Vector3d> far{{-40, 0, 0}, {-41, 0, 0}};
  const MotionFit open(checker);
  CHECK(open.fit(std::vector<Quaternion>{{1, 0, 0, 0}, {1, 0, 0, 0}}, far, 1, 0.1) == Approx(0.1));
  CHECK(far[0] == Vector3d(-40, 0, 0));
}

}  // namespace
}  // namespace nef::planner::test::motion_fit
