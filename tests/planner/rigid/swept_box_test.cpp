// SPDX-License-Identifier: Apache-2.0
//
// Boxes in any direction hold what they are made of, exactly; and boxes of a moving body that are said to be apart from
// others are, exactly, where the gap is next to nothing.
#include "apps/planner/rigid/swept_box.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/intersection/hulls_apart.h"
#include "nef/construct/convex_hull.h"
#include "nef/polyhedron.h"

namespace nef::planner::test::swept_box {
namespace {

Rational determinant(const Rational3& a, const Rational3& b, const Rational3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Rational3 exact_vector(const Vector3d& v) { return {exact_rational(v[0]), exact_rational(v[1]), exact_rational(v[2])}; }

// By Cramer's rule: centre + axes x = p has a solution x within the halves.
bool holds(const OrientedBox& box, const Rational3& p) {
  const Rational3 centre = exact_vector(box.centre);
  const Rational3 from_centre{p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
  const std::array<Rational3, 3> axes{exact_vector(box.axes.col(0)), exact_vector(box.axes.col(1)),
                                      exact_vector(box.axes.col(2))};
  const Rational whole = determinant(axes[0], axes[1], axes[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<Rational3, 3> columns = axes;
    columns[k] = from_centre;
    const Rational x = determinant(columns[0], columns[1], columns[2]) / whole;
    if (abs(x) > exact_rational(box.half[static_cast<Eigen::Index>(k)])) return false;
  }
  return true;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}
  long between(long low, long high) { return std::uniform_int_distribution<long>(low, high)(random_); }
  Rational third(long size) {
    Rational result(between(-3 * size, 3 * size), 3);
    result.canonicalize();
    return result;
  }
  Rational3 point(long size) { return {third(size), third(size), third(size)}; }
  Quaternion quaternion() { return {between(1, 9), between(-9, 9), between(-9, 9), between(-9, 9)}; }

 private:
  std::mt19937_64 random_;
};

// The corners of a cuboid in a random direction.
std::vector<Rational3> cuboid(Random& random) {
  const Quaternion q = random.quaternion();
  const Matrix3 turn = rotation_between(q, q);
  const Rational3 at = random.point(3);
  const Rational3 half{random.between(1, 9), random.between(1, 9), Rational(1, random.between(1, 9))};
  std::vector<Rational3> corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Rational3 p = at;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 3; ++j) {
        if ((corner >> j & 1U) != 0) {
          p[k] += turn[k][j] * half[j];
        } else {
          p[k] -= turn[k][j] * half[j];
        }
      }
    }
    corners.push_back(p);
  }
  return corners;
}

RigidMotion motion_at(double along, const Rational3& direction, const RigidPose& from, const RigidPose& to) {
  const Rational s = exact_rational(along);
  RigidPose a = from;
  RigidPose b = to;
  for (std::size_t k = 0; k < 3; ++k) {
    a.position[k] += s * direction[k];
    b.position[k] += s * direction[k];
  }
  return {a, b};
}

}  // namespace

TEST_CASE("A box in any direction holds the points that it is made of, exactly", "[rigid][bounds]") {
  Random random(20261127);
  for (int i = 0; i < 200; ++i) {
    std::vector<Rational3> exact;
    std::vector<Vector3d> points;
    for (long n = random.between(1, 8); n > 0; --n) {
      exact.push_back(random.point(i % 3 == 0 ? 1000000 : 5));
      points.push_back(to_vector(exact.back()));
    }
    const Quaternion q = random.quaternion();
    const Matrix3 turn = rotation_between(q, q);
    Eigen::Matrix3d axes;
    for (int k = 0; k < 3; ++k) axes.row(k) = to_vector(turn[static_cast<std::size_t>(k)]);
    const Vector3d normal = axes.col(0).normalized();
    const Eigen::Matrix3d skew = Eigen::Matrix3d::Constant(0.5);  // no axes: the box takes others
    for (const Eigen::Matrix3d& each : {axes, axes_of_scatter(points), axes_of_polygon(points, normal), skew}) {
      const OrientedBox box = box_around(points, each);
      for (const Rational3& p : exact) CHECK(holds(box, p));
    }
  }
}

TEST_CASE("Boxes that are said to be apart from a moving one are, next to contact", "[rigid][bounds]") {
  Random random(38);
  int tight = 0;
  int poses = 0;
  for (int i = 0; i < 120; ++i) {
    const std::vector<Rational3> corners = cuboid(random);
    const std::vector<Rational3> others = cuboid(random);
    const RigidBody moving = RigidBody::of_set(convex_hull(corners));
    const RigidBody fixed = RigidBody::of_set(convex_hull(others));
    REQUIRE(moving.nodes().size() == 1);
    const Rational3 direction{random.between(1, 5), random.between(-5, 5), random.between(-5, 5)};
    const RigidPose from{random.point(2), random.quaternion()};
    RigidPose to = from;
    const bool is_pose = i % 2 == 0;
    if (!is_pose) {
      to.position = random.point(3);
      if (i % 4 == 1) to.quaternion = random.quaternion();
    }
    const auto apart = [&](double along) {
      const RigidMotion motion = motion_at(along, direction, from, to);
      const MotionCells cells(motion);
      const MotionCell cell = is_pose ? cells.pose(0) : cells.part(0, 0.25);
      if (cell.wide) return along > 50;
      return SweptBoxes(cell).apart(moving.nodes()[0], fixed.nodes()[0]);
    };
    const auto truly_apart = [&](double along) {
      const RigidMotion motion = motion_at(along, direction, from, to);
      const MotionCells cells(motion);
      const auto images = cells.exact_images(0, is_pose ? 0 : 0.25, corners);
      return hulls_are_apart(images, others, true);
    };
    // Where apart() becomes true.
    double low = 0;
    double high = 100;
    if (apart(low)) continue;
    REQUIRE(apart(high));
    while (high - low > 0x1p-44) ((apart((low + high) / 2) ? high : low) = (low + high) / 2);
    CHECK(truly_apart(high));
    if (!is_pose) continue;
    ++poses;
    if (!truly_apart(high - 0x1p-30)) ++tight;
  }
  // Two cuboids that stay are apart if one of fifteen directions says so, so the bound alone is lost.
  CHECK(tight == poses);
  CHECK(poses > 20);
}

}  // namespace nef::planner::test::swept_box
