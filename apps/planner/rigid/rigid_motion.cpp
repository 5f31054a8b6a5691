// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/rigid_motion.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"

namespace nef::planner {
namespace {

using Double4 = std::array<double, 4>;

Double4 rounded(const Quaternion& q) {
  return {nearest_double(q[0]), nearest_double(q[1]), nearest_double(q[2]), nearest_double(q[3])};
}

// A product or a sum of four products of rounded components no larger than 1.01 is off by less than this.
constexpr double kProductError = 0x1p-48;

double rounded_product(const Double4& p, const Double4& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

double length_of(const Double4& q) { return std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])); }

// The quaternion with a length near 1. One that is near 1 already stays as it is, so that numbers stay short.
Quaternion scaled(const Quaternion& q) {
  const Double4 near = rounded(q);
  if (std::fabs(rounded_product(near, near) - 1) < 0x1p-20 - kProductError) return q;
  Rational largest = 0;
  for (const Rational& x : q) largest = std::max(largest, Rational(abs(x)));
  if (largest == 0) throw InputError("a rotation's quaternion must not be zero");
  const Rational square = scalar_product(q, q);
  if (square > Rational(1) - Rational(1, 1 << 20) && square < Rational(1) + Rational(1, 1 << 20)) return q;
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = q[k] / largest;
  const Rational factor = exact_rational(1 / length_of(rounded(result)));
  for (Rational& x : result) x *= factor;
  return result;
}

// Twice the arc sine of half the chord: exact to a few units for small angles, too.
double angle_between(const Double4& p, const Double4& q) {
  const double p_length = length_of(p);
  const double q_length = length_of(q);
  Double4 chord{};
  for (std::size_t k = 0; k < 4; ++k) chord[k] = p[k] / p_length - q[k] / q_length;
  return 2 * std::asin(std::min(1.0, length_of(chord) / 2));
}

bool same_rotation(const Quaternion& p, const Quaternion& q, const Double4& near_p, const Double4& near_q) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (std::fabs(near_p[i] * near_q[j] - near_p[j] * near_q[i]) > kProductError) return false;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (p[i] * q[j] != p[j] * q[i]) return false;
    }
  }
  return true;
}

}  // namespace

Rational scalar_product(const Quaternion& p, const Quaternion& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

Matrix3 rotation_between(const Quaternion& p, const Quaternion& q) {
  // The polarized quadratic form of the rotation matrix: each product x y of components becomes their mixed product.
  const auto mixed = [&](std::size_t i, std::size_t j) { return Rational((p[i] * q[j] + p[j] * q[i]) / 2); };
  const Rational ww = p[0] * q[0];
  const Rational xx = p[1] * q[1];
  const Rational yy = p[2] * q[2];
  const Rational zz = p[3] * q[3];
  const Rational whole = ww + xx + yy + zz;
  Matrix3 m;
  m[0] = {ww + xx - yy - zz, 2 * (mixed(1, 2) - mixed(0, 3)), 2 * (mixed(1, 3) + mixed(0, 2))};
  m[1] = {2 * (mixed(1, 2) + mixed(0, 3)), ww - xx + yy - zz, 2 * (mixed(2, 3) - mixed(0, 1))};
  m[2] = {2 * (mixed(1, 3) - mixed(0, 2)), 2 * (mixed(2, 3) + mixed(0, 1)), ww - xx - yy + zz};
  for (Rational3& row : m) {
    for (Rational& entry : row) entry /= whole;
  }
  return m;
}

RigidMotion::RigidMotion(RigidPose from, RigidPose to, MotionTiming timing)
    : from_(std::move(from)), to_(std::move(to)), timing_(timing) {
  from_.quaternion = scaled(from_.quaternion);
  to_.quaternion = scaled(to_.quaternion);
  const Double4 p = rounded(from_.quaternion);
  Double4 q = rounded(to_.quaternion);
  turns_ = !same_rotation(from_.quaternion, to_.quaternion, p, q);
  const double product = rounded_product(p, q);
  if (!turns_) {
    to_.quaternion = from_.quaternion;
    q = p;
  } else if (std::fabs(product) > kProductError ? product < 0 : scalar_product(from_.quaternion, to_.quaternion) < 0) {
    for (Rational& x : to_.quaternion) x = -x;
    for (double& x : q) x = -x;
  }
  angle_ = angle_between(p, q);
  from_length_ = length_of(p);
  to_length_ = length_of(q);
}

Quaternion RigidMotion::quaternion(const Rational& s) const {
  if (!turns_) return from_.quaternion;
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) {
    result[k] = from_.quaternion[k] + s * (to_.quaternion[k] - from_.quaternion[k]);
  }
  return result;
}

double RigidMotion::time_of(double s) const {
  if (timing_ == MotionTiming::kRational || !turns_ || s == 0 || s == 1) return s;
  const double near = (1 - s) * from_length_;
  const double far = s * to_length_;
  constexpr double kSmall = 0x1p-14;  // see kTimeError
  const double time =
      angle_ < kSmall ? far / (near + far) : std::atan2(far * std::sin(angle_), near + far * std::cos(angle_)) / angle_;
  return std::clamp(time, 0.0, 1.0);
}

RigidPose RigidMotion::at(double s) const {
  if (s == 0) return from_;
  if (s == 1) return to_;
  const Rational time = exact_rational(time_of(s));
  RigidPose pose;
  pose.quaternion = quaternion(exact_rational(s));
  for (std::size_t k = 0; k < 3; ++k) {
    pose.position[k] = from_.position[k] + time * (to_.position[k] - from_.position[k]);
  }
  return pose;
}

}  // namespace nef::planner
