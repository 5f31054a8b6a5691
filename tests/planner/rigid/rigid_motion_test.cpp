// SPDX-License-Identifier: Apache-2.0
//
// Rotations of arcs against their definition, and the doubles of motion cells against exact numbers.
#include "apps/planner/rigid/rigid_motion.h"

#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/planner/rigid/motion_cell.h"
#include "nef/base/error.h"

namespace nef::planner::test::rigid_motion {
namespace {

Quaternion random_quaternion(int largest) {
  Quaternion q;
  do {
    for (Rational& x : q) x = *rc::gen::inRange(-largest, largest + 1);
  } while (q == Quaternion{});
  return q;
}

Rational3 random_vector(int largest) {
  Rational3 v;
  for (Rational& x : v) x = Rational(*rc::gen::inRange(-largest, largest + 1)) / *rc::gen::inRange(1, 4);
  return v;
}

Rational3 times(const Matrix3& m, const Rational3& v) {
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = m[k][0] * v[0] + m[k][1] * v[1] + m[k][2] * v[2];
  return result;
}

// q v conj(q) / <q, q>, by the product of quaternions.
Rational3 rotated(const Quaternion& q, const Rational3& v) {
  const auto product = [](const Quaternion& a, const Quaternion& b) {
    return Quaternion{
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  };
  const Quaternion turned = product(product(q, {0, v[0], v[1], v[2]}), {q[0], -q[1], -q[2], -q[3]});
  const Rational square = scalar_product(q, q);
  return {turned[1] / square, turned[2] / square, turned[3] / square};
}

}  // namespace

TEST_CASE("A quaternion's matrix rotates as the product of quaternions does", "[rigid]") {
  CHECK(rc::check([] {
    const Quaternion q = random_quaternion(9);
    const Rational3 v = random_vector(9);
    RC_ASSERT(times(rotation_between(q, q), v) == rotated(q, v));
  }));
}

TEST_CASE("Rotations of an arc are convex combinations of three matrices", "[rigid]") {
  CHECK(rc::check([] {
    const Quaternion p = random_quaternion(9);
    Quaternion q = random_quaternion(9);
    RC_PRE(scalar_product(p, q) != 0);
    if (scalar_product(p, q) < 0) {
      for (Rational& x : q) x = -x;
    }
    const Rational s = Rational(*rc::gen::inRange(0, 33)) / 32;
    const Rational3 v = random_vector(9);
    Quaternion at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = (1 - s) * p[k] + s * q[k];
    // The Bernstein weights, which are not negative.
    const std::array<Rational, 3> weights{(1 - s) * (1 - s) * scalar_product(p, p),
                                          2 * s * (1 - s) * scalar_product(p, q), s * s * scalar_product(q, q)};
    const std::array<Rational3, 3> corners{times(rotation_between(p, p), v), times(rotation_between(p, q), v),
                                           times(rotation_between(q, q), v)};
    const Rational whole = weights[0] + weights[1] + weights[2];
    Rational3 combined;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) combined[k] += weights[i] * corners[i][k] / whole;
    }
    RC_ASSERT(combined == rotated(at, v));
  }));
}

TEST_CASE("A motion takes the shorter arc and keeps its ends", "[rigid]") {
  const RigidMotion motion({{0, 0, 0}, {1, 0, 0, 0}}, {{4, 0, 0}, {-3, 0, 0, -3}});
  CHECK(motion.turns());
  CHECK(scalar_product(motion.from().quaternion, motion.to().quaternion) > 0);
  CHECK(rotated(motion.to().quaternion, {1, 0, 0}) == Rational3{0, 1, 0});
  CHECK(motion.at(0.5).position == Rational3{2, 0, 0});
  CHECK_FALSE(RigidMotion({{0, 0, 0}, {1, 1, 0, 0}}, {{1, 0, 0}, {-2, -2, 0, 0}}).turns());
  CHECK_THROWS_AS(RigidMotion({{0, 0, 0}, {0, 0, 0, 0}}, {{1, 0, 0}, {1, 0, 0, 0}}), InputError);
}

TEST_CASE("The time of a slerp is that of its angle", "[rigid]") {
  CHECK(rc::check([] {
    const Quaternion p = random_quaternion(100);
    Quaternion q = random_quaternion(100);
    const bool close = *rc::gen::arbitrary<bool>();
    if (close) {
      for (std::size_t k = 0; k < 4; ++k) q[k] = p[k] + q[k] / (std::int64_t{1} << *rc::gen::inRange(4, 40));
    }
    RC_PRE(scalar_product(p, q) != 0 && q != Quaternion{});
    const RigidMotion motion({{0, 0, 0}, p}, {{1, 0, 0}, q}, MotionTiming::kSlerp);
    RC_PRE(motion.turns());
    const double s = *rc::gen::inRange(0, 1025) / 1024.0;
    // The part of the angle that the arc has gone at s, in long doubles from scratch: atan2 of the wedge product's
    // length and the scalar product.
    const auto angle_to = [&](const Quaternion& at) {
      const Quaternion& from = motion.from().quaternion;
      Rational square = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
          const Rational w = from[i] * at[j] - from[j] * at[i];
          square += w * w;
        }
      }
      return std::atan2(std::sqrt(static_cast<long double>(nearest_double(square))),
                        static_cast<long double>(nearest_double(scalar_product(from, at))));
    };
    const long double truth = angle_to(motion.quaternion(exact_rational(s))) / angle_to(motion.to().quaternion);
    RC_ASSERT(std::fabs(static_cast<double>(truth) - motion.time_of(s)) <= RigidMotion::kTimeError);
  }));
}

TEST_CASE("Images in doubles are within their bound of the exact ones", "[rigid]") {
  double worst = 0;  // in parts of the bound
  CHECK(rc::check([&worst] {
    const bool slerp = *rc::gen::arbitrary<bool>();
    const RigidMotion motion({random_vector(1000), random_quaternion(1000)},
                             {random_vector(1000), random_quaternion(1000)},
                             slerp ? MotionTiming::kSlerp : MotionTiming::kRational);
    const MotionCells cells(motion);
    const double a = *rc::gen::inRange(0, 1024) / 1024.0;
    const double b = std::min(1.0, a + std::ldexp(1.0, -*rc::gen::inRange(1, 10)));
    const MotionCell cell = cells.part(a, b);
    if (cell.wide) return;
    const Rational3 point = random_vector(100);
    std::vector<Vector3d> images;
    cell.for_each_image(to_vector(point), [&](const Vector3d& image) { images.push_back(image); });
    const std::vector<Rational3> exact = cells.exact_images(a, b, std::vector{point});
    RC_ASSERT(images.size() == exact.size());
    const double bound = MotionCell::kImageError * (to_vector(point).lpNorm<1>() + cell.position_reach);
    for (std::size_t i = 0; i < images.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational off = abs(exact[i][k] - exact_rational(images[i][static_cast<Eigen::Index>(k)]));
        RC_ASSERT(nearest_double(off) <= bound);
        worst = std::max(worst, nearest_double(off) / bound);
      }
    }
  }));
  CHECK(worst > 1e-4);  // the bound is not absurd
}

}  // namespace nef::planner::test::rigid_motion
