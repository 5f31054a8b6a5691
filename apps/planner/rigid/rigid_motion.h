// SPDX-License-Identifier: Apache-2.0
//
// Poses and motions of a rigid body in space, with exact numbers and without charts of the rotation group.
//
// For a quaternion q the rotated vector is R(q) v = B(q, q) v / <q, q>, where B is bilinear. Let q run over the arc
// (1 - s) p + s q of two quaternions with <p, q> > 0. Then R(q(s)) v is a rational quadratic curve with the control
// points R(p) v, M(p, q) v and R(q) v, M(p, q) = B(p, q) / <p, q>, and positive weights: it stays in their hull.
// Everything is rational, and arcs nest under bisection.
#pragma once

#include <array>
#include <cstdint>

#include "nef/number/number.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// A rotation as a quaternion w, x, y, z of any length except zero: (1, 1, 0, 0) is a quarter turn about the x axis.
using Quaternion = std::array<Rational, 4>;

/// Three rows.
using Matrix3 = std::array<Rational3, 3>;

/// The matrix M(p, q) above; M(q, q) is the rotation matrix of q. The scalar product of p and q must not be zero.
Matrix3 rotation_between(const Quaternion& p, const Quaternion& q);

/// The scalar product of two quaternions.
Rational scalar_product(const Quaternion& p, const Quaternion& q);

/// Where a body is: a point v of it is at R(quaternion) v + position.
struct RigidPose {
  Rational3 position;
  Quaternion quaternion{1, 0, 0, 0};
};

/// Places a body at a pose.
inline AffineMap map_of(const RigidPose& pose) {
  return {rotation_between(pose.quaternion, pose.quaternion), pose.position};
}

/// How the translation of a motion goes along with its rotation.
enum class MotionTiming : std::uint8_t {
  kRational,  ///< both are linear in the parameter of the arc: position (1 - s) a + s b, quaternion (1 - s) p + s q
  kSlerp      ///< the angle grows evenly with the position, as OMPL's SE3StateSpace and most programs interpolate
};

/// From one pose to another: the position goes straight, the rotation along the shorter arc of quaternions. Of two
/// rotations that are a half turn apart, the arc goes through the sum of both quaternions as they are given.
class RigidMotion {
 public:
  /// Throws InputError if a quaternion is zero.
  RigidMotion(RigidPose from, RigidPose to, MotionTiming timing = MotionTiming::kRational);

  [[nodiscard]] const RigidPose& from() const { return from_; }
  /// The quaternions of both ends have about the same length, and their scalar product is not negative.
  [[nodiscard]] const RigidPose& to() const { return to_; }
  [[nodiscard]] MotionTiming timing() const { return timing_; }
  /// False if both ends have the same rotation.
  [[nodiscard]] bool turns() const { return turns_; }
  /// False if both ends have the same position.
  [[nodiscard]] bool moves() const { return from_.position != to_.position; }

  /// The quaternion of the arc at s, 0 <= s <= 1.
  [[nodiscard]] Quaternion quaternion(const Rational& s) const;
  /// The part of the way that the position has gone when the rotation is at s: s itself, or for kSlerp a double within
  /// kTimeError of it.
  [[nodiscard]] double time_of(double s) const;
  /// The pose at s; for kSlerp, one whose position is off by kTimeError of the way at most.
  [[nodiscard]] RigidPose at(double s) const;

  /// For quaternions that are less than 2^-14 apart, time is taken to go as the parameter of the arc does, which is
  /// right within a tenth of the square of that angle, 2^-31. Otherwise sine and cosine of the angle are off by less
  /// than 2^-49 and the angle itself, at least 2^-14, by a part of 2^-36; the quotient depends on an error of the angle
  /// only through its square, so it is off by less than 2^-34.
  static constexpr double kTimeError = 0x1p-30;

 private:
  RigidPose from_;
  RigidPose to_;
  MotionTiming timing_;
  bool turns_ = false;
  double angle_ = 0;        // between the quaternions
  double from_length_ = 1;  // of the quaternions
  double to_length_ = 1;
};

}  // namespace nef::planner
