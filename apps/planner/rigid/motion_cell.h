// SPDX-License-Identifier: Apache-2.0
//
// What a body sweeps in a part of its motion, enclosed by the hull of a few images of its vertices.
//
// Over a part of an arc, every rotation of a vertex lies in the hull of three images, those by R(p), M(p, q) and R(q)
// (rigid_motion.h), and every position on a segment. The sum of both hulls encloses the vertex at every time, whatever
// the rotation and the position do in between, and the hull of these sums over the vertices of a convex piece encloses
// the piece.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// The images of points in a part of a motion, in doubles. A coordinate of an image of a point p that was rounded to
/// doubles is off by at most kImageError (|p|_1 + position_reach) + kVanished.
struct MotionCell {
  /// With u = 2^-53 and quaternions of length 1 or less (and 0.7 or more): the ends' components are off by u, those of
  /// p and q at a parameter by 5 u, entries of B and the scalar product by 25 u each. The scalar product is at least
  /// 0.35 and the entries of M at most 1.42 unless the cell is wide, so these are off by 180 u; an image is off by that
  /// times |p|_1, by 9 u of it for rounding p and three products, and by 7 u of the position. 256 u is more than that.
  static constexpr double kImageError = 0x1p-45;
  /// More than all that may vanish: what is below 2^-1022, a coordinate or a product, is off by 2^-1074, and factors
  /// are at most 2.
  static constexpr double kVanished = 1e-300;

  std::array<Eigen::Matrix3d, 3> turns;
  std::size_t turn_count = 1;  ///< 1 if the rotation stays, else 3
  std::array<Vector3d, 2> positions;
  std::size_t position_count = 1;  ///< 1 if the position stays, else 2
  bool wide = false;           ///< the rotation goes too far (over 90 degrees): there are no images, turns are not set
  double position_reach = 0;   ///< no |x| + |y| + |z| of a position is larger
  double turn_spread = 0;      ///< about how far the rotation takes a point at distance 1
  double position_spread = 0;  ///< about how far the position goes
  double slack = 0;            ///< what is enclosed may be farther out than the images by so much

  /// The images of a point.
  template <typename Visit>
  void for_each_image(const Vector3d& p, Visit&& visit) const {
    for (std::size_t i = 0; i < turn_count; ++i) {
      const Vector3d turned = turns[i] * p;
      for (std::size_t k = 0; k < position_count; ++k) visit(Vector3d(turned + positions[k]));
    }
  }
};

/// Makes the cells of one motion.
class MotionCells {
 public:
  explicit MotionCells(const RigidMotion& motion);

  /// The part of the motion from parameter a to b, 0 <= a < b <= 1. Positions are enclosed although times are rounded.
  [[nodiscard]] MotionCell part(double a, double b) const;
  /// The pose at a parameter: one image for each point. Positions are those of the motion up to position_error().
  [[nodiscard]] MotionCell pose(double s) const;
  /// How far the position of pose(s) may be from that of the motion, beyond rounding.
  [[nodiscard]] double position_error() const { return position_error_; }

  /// The images of points in a part of the motion, exactly: the hull is that of part(a, b).
  [[nodiscard]] std::vector<Rational3> exact_images(double a, double b, std::span<const Rational3> points) const;
  /// The images of points by the rotation at a parameter, with the position at a time, exactly.
  [[nodiscard]] std::vector<Rational3> exact_images_at(double s, double time, std::span<const Rational3> points) const;
  /// How far the position has gone from parameter a to b: an interval that holds the true one, although times are
  /// rounded.
  [[nodiscard]] std::array<double, 2> times(double a, double b) const;

  [[nodiscard]] const RigidMotion& motion() const { return *motion_; }

 private:
  using Double4 = std::array<double, 4>;
  [[nodiscard]] Double4 quaternion(double s) const;
  [[nodiscard]] Vector3d position(double time) const;
  [[nodiscard]] Rational3 exact_position(double time) const;

  const RigidMotion* motion_;  // outlives this
  Double4 p_;
  Double4 q_;
  Vector3d from_;
  Vector3d to_;
  double position_error_ = 0;
};

}  // namespace nef::planner
