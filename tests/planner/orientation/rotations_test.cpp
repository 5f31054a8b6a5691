// SPDX-License-Identifier: Apache-2.0
//
// Grids of rotations, and the random numbers and metric of searches (pose_metric.h).
#include "apps/planner/orientation/rotations.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "apps/planner/rigid_search/pose_metric.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::rotations {
namespace {

TEST_CASE("The grids of rotations nest, and are connected", "[rigid]") {
  std::set<Quaternion> grid{{1, 0, 0, 0}};
  for (const unsigned level : {0U, 1U}) {
    std::vector<Quaternion> open(grid.begin(), grid.end());
    while (!open.empty()) {
      const Quaternion q = open.back();
      open.pop_back();
      for (const Quaternion& next : grid_neighbours(q, level)) {
        CHECK(canonical(next) == next);
        CHECK(is_in_grid(next, level));
        CHECK(scalar_product(q, next) != 0);
        if (grid.insert(next).second) open.push_back(next);
      }
    }
    CHECK(grid.size() == (level == 0 ? 40 : 272));  // ((2^(l+1) + 1)^4 - (2^(l+1) - 1)^4) / 2
  }
}

TEST_CASE("A rotation between those of a grid lies in a cell of it", "[rigid]") {
  const Quaternion q = canonical({5, 1, -2, 0});
  const std::vector<Quaternion> corners = grid_neighbours(q, 1);
  CHECK(corners.size() == 4);
  for (const Quaternion& corner : corners) CHECK(angle_between(q, corner) < 1);
  CHECK(rounded_to_grid({0.98, 0.21, -0.4, 0.01}, 2) == Quaternion{1, Rational(1, 4), Rational(-1, 2), 0});
}

TEST_CASE("Angles between rotations are nearly right", "[rigid]") {
  RandomNumbers random(7);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Quaterniond a = random.rotation();
    const Eigen::Quaterniond b = random.rotation();
    const auto exact = [](const Eigen::Quaterniond& q) {
      return Quaternion{exact_rational(q.w()), exact_rational(q.x()), exact_rational(q.y()), exact_rational(q.z())};
    };
    const double angle = 2 * std::acos(std::min(1.0, std::fabs(a.dot(b))));
    CHECK(std::fabs(angle_between(exact(a), exact(b)) - angle) <= angle / 12 + 1e-6);
  }
}

TEST_CASE("Products and arcs of rotations", "[rigid]") {
  const Quaternion quarter_z{1, 0, 0, 1};
  const Quaternion quarter_x{1, 1, 0, 0};
  CHECK(canonical(product(quarter_x, quarter_z)) == Quaternion{1, 1, -1, 1});  // first about z, then about x
  CHECK(rotation_at({1, 0, 0, 0}, {-1, 0, 0, 1}, Rational(1, 2)) == Quaternion{1, 0, 0, Rational(-1, 2)});
  const PoseMetric metric(2);
  const RigidPose a{{0, 0, 0}};
  const RigidPose b{{3, 0, 4}, {1, 0, 0, 1}};
  CHECK(metric.distance(a, a) == Approx(0));
  CHECK(metric.distance(a, b) == Approx(5 + 4 * std::sqrt(2 - std::sqrt(2.0))));
  const RigidPose half = metric.between(a, to_vector(b.position), PoseMetric::rounded(b.quaternion), 0.5);
  CHECK(metric.distance(a, half) == Approx(metric.distance(half, b)).epsilon(0.05));
}

}  // namespace
}  // namespace nef::planner::test::rotations
