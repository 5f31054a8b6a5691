// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/motion_cell.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

double scalar(const std::array<double, 4>& p, const std::array<double, 4>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

// rotation_between (rigid_motion.h) in doubles, given <p, q>.
Eigen::Matrix3d matrix_between(const std::array<double, 4>& p, const std::array<double, 4>& q, double whole) {
  const auto twice = [&](std::size_t i, std::size_t j) { return p[i] * q[j] + p[j] * q[i]; };
  const double ww = p[0] * q[0];
  const double xx = p[1] * q[1];
  const double yy = p[2] * q[2];
  const double zz = p[3] * q[3];
  Eigen::Matrix3d m;
  m << ww + xx - yy - zz, twice(1, 2) - twice(0, 3), twice(1, 3) + twice(0, 2),  //
      twice(1, 2) + twice(0, 3), ww - xx + yy - zz, twice(2, 3) - twice(0, 1),   //
      twice(1, 3) - twice(0, 2), twice(2, 3) + twice(0, 1), ww - xx - yy + zz;
  return m / whole;
}

std::vector<Rational3> images_by(const std::vector<Matrix3>& turns, const std::vector<Rational3>& positions,
                                 std::span<const Rational3> points) {
  std::vector<Rational3> images;
  for (const Rational3& v : points) {
    for (const Matrix3& turn : turns) {
      Rational3 turned;
      for (std::size_t k = 0; k < 3; ++k) turned[k] = turn[k][0] * v[0] + turn[k][1] * v[1] + turn[k][2] * v[2];
      for (const Rational3& at : positions) images.push_back({turned[0] + at[0], turned[1] + at[1], turned[2] + at[2]});
    }
  }
  return images;
}

}  // namespace

MotionCells::MotionCells(const RigidMotion& motion)
    : motion_(&motion), from_(to_vector(motion.from().position)), to_(to_vector(motion.to().position)) {
  for (std::size_t k = 0; k < 4; ++k) {
    p_[k] = nearest_double(motion.from().quaternion[k]);
    q_[k] = nearest_double(motion.to().quaternion[k]);
  }
  if (motion.timing() == MotionTiming::kSlerp && motion.turns()) {
    position_error_ = RigidMotion::kTimeError * (to_ - from_).lpNorm<1>() * (1 + 0x1p-40);
  }
}

MotionCells::Double4 MotionCells::quaternion(double s) const {
  Double4 result{};
  for (std::size_t k = 0; k < 4; ++k) result[k] = (1 - s) * p_[k] + s * q_[k];
  return result;
}

Vector3d MotionCells::position(double time) const { return (1 - time) * from_ + time * to_; }

Rational3 MotionCells::exact_position(double time) const {
  const Rational t = exact_rational(time);
  const Rational3& from = motion_->from().position;
  const Rational3& to = motion_->to().position;
  return {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])};
}

std::array<double, 2> MotionCells::times(double a, double b) const {
  const double slack = position_error_ > 0 ? RigidMotion::kTimeError : 0;
  const double low = a == 0 ? 0 : std::max(0.0, motion_->time_of(a) - slack);
  const double high = b == 1 ? 1 : std::min(1.0, motion_->time_of(b) + slack);
  return {low, high};
}

MotionCell MotionCells::part(double a, double b) const {
  MotionCell cell;
  const Double4 p = quaternion(a);
  const double pp = scalar(p, p);
  if (motion_->turns()) {
    const Double4 q = quaternion(b);
    const double pq = scalar(p, q);
    const double qq = scalar(q, q);
    cell.wide = pq * pq < pp * qq / 2;
    if (cell.wide) return cell;
    cell.turn_count = 3;
    cell.turns = {matrix_between(p, p, pp), matrix_between(p, q, pq), matrix_between(q, q, qq)};
    cell.turn_spread = (cell.turns[2] - cell.turns[0]).norm();
  } else {
    cell.turns[0] = matrix_between(p, p, pp);
  }
  const auto [low, high] = times(a, b);
  cell.positions[0] = position(low);
  if (motion_->moves()) {
    cell.position_count = 2;
    cell.positions[1] = position(high);
    cell.position_spread = (cell.positions[1] - cell.positions[0]).norm();
  }
  cell.position_reach = std::max(from_.lpNorm<1>(), to_.lpNorm<1>());
  return cell;
}

MotionCell MotionCells::pose(double s) const {
  MotionCell cell;
  const Double4 q = quaternion(s);
  cell.turns[0] = matrix_between(q, q, scalar(q, q));
  cell.positions[0] = position(motion_->time_of(s));
  cell.position_reach = std::max(from_.lpNorm<1>(), to_.lpNorm<1>());
  return cell;
}

std::vector<Rational3> MotionCells::exact_images(double a, double b, std::span<const Rational3> points) const {
  std::vector<Matrix3> turns;
  const Quaternion p = motion_->quaternion(exact_rational(a));
  turns.push_back(rotation_between(p, p));
  if (a != b && motion_->turns()) {
    const Quaternion q = motion_->quaternion(exact_rational(b));
    turns.push_back(rotation_between(p, q));
    turns.push_back(rotation_between(q, q));
  }
  std::vector<Rational3> positions;
  const std::array<double, 2> ends = a == b ? std::array{motion_->time_of(a), motion_->time_of(a)} : times(a, b);
  for (const double time : ends) {
    positions.push_back(exact_position(time));
    if (a == b || !motion_->moves()) break;
  }
  return images_by(turns, positions, points);
}

std::vector<Rational3> MotionCells::exact_images_at(double s, double time, std::span<const Rational3> points) const {
  const Quaternion q = motion_->quaternion(exact_rational(s));
  return images_by({rotation_between(q, q)}, {exact_position(time)}, points);
}

}  // namespace nef::planner
