// SPDX-License-Identifier: Apache-2.0
//
// Within a quarter, the quaternion of a turn is linear in it (turning/turn.h), so a hinge's cell is an arc with the
// value as its parameter. A screw's cell is a part of a motion over a whole quarter whose position goes evenly with the
// angle (MotionTiming::kSlerp), which is the screw's own motion. A four-bar linkage's is the pose in the middle and a
// ball.
#include "apps/planner/mechanism/joint.h"

#include <cmath>

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

RigidMotion quarter_of(const TurningAxis& axis, const Rational3& way, const Integer& quarter) {
  const Rational k(quarter);
  const auto at = [&](const Rational& turn) {
    return RigidPose{{turn * way[0], turn * way[1], turn * way[2]}, axis.quaternion(turn)};
  };
  return {at(k), at(k + 1), MotionTiming::kSlerp};
}

double degrees_of(const Quaternion& q) {
  const double w = nearest_double(q[0]);
  const double s = std::sqrt(nearest_double(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]));
  return std::atan2(s, w) * 360 / M_PI;
}

// `away`: how far the point about which the link turns is from the origin.
Joint::Sweep sweep_of(const FourBar::Place& place, double away, double reach) {
  constexpr double kSpare = 1 + 0x1p-20;  // for the roundings of sums here
  Joint::Sweep sweep;
  double turn_square = 0;
  double shift_square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      const Interval& entry = place.turn[i][j];
      sweep.all.turns[0](row, static_cast<Eigen::Index>(j)) = entry.middle();
      turn_square += entry.radius() * entry.radius();
    }
    sweep.all.positions[0][row] = place.shift[i].middle();
    shift_square += place.shift[i].radius() * place.shift[i].radius();
  }
  sweep.all.position_reach = sweep.all.positions[0].lpNorm<1>();
  const double rounding = (std::sqrt(turn_square) * (reach + away) + std::sqrt(shift_square)) * kSpare;
  const double way = (place.way + place.turned * reach) * kSpare;
  sweep.all.slack = rounding + way;
  sweep.middle = sweep.all;
  sweep.middle.slack = rounding;
  // The turn is rounded, so points are off by that. So are turned normals, as a part of their length, and by that times
  // differences of points no longer than twice the reach: 8 times the error of points is more than all.
  sweep.middle_error = 8 * rounding + way;
  return sweep;
}

}  // namespace

Joint Joint::hinge(const Rational3& axis, const Rational3& point) {
  Joint joint(Kind::kHinge, axis);
  joint.point_ = point;
  return joint;
}

Joint Joint::slider(const Rational3& direction) { return Joint(Kind::kSlider, direction); }

Joint Joint::screw(const Rational3& axis, const Rational3& point, const Rational& pitch) {
  Joint joint(Kind::kScrew, axis);
  joint.point_ = point;
  if (joint.axis_.square() != 1) throw InputError("the axis of a screw must have a rational length, as (1, 2, 2) has");
  for (std::size_t k = 0; k < 3; ++k) joint.direction_[k] = pitch / 4 * joint.axis_.direction()[k];
  return joint;
}

Joint Joint::four_bar(const Rational3& axis, const std::array<Rational3, 2>& pivots,
                      const std::array<Rational3, 2>& pins, FourBar::Link link) {
  Joint joint(Kind::kFourBar, axis);
  joint.point_ = pivots[0];
  joint.bars_.emplace(joint.axis_, minus(pivots[1], pivots[0]),
                      std::array{minus(pins[0], pivots[0]), minus(pins[1], pivots[0])}, link);
  return joint;
}

void Joint::require_range(const Rational& low, const Rational& high) const {
  if (!bars_) return;
  const auto require = [&](const auto& self, const Rational& from, const Rational& to, unsigned depth) -> void {
    if (bars_->place(arc(from, to))) return;
    constexpr unsigned kMostHalvings = 24;
    if (depth == kMostHalvings) {
      throw InputError(
          "coupler and rocker of the four-bar linkage are in one line, or do not meet, when the crank is at " +
          std::to_string(measure_of(from)) + " degrees; the range must end before");
    }
    const Rational middle = (from + to) / 2;
    self(self, from, middle, depth + 1);
    self(self, middle, to, depth + 1);
  };
  std::vector<Rational> ends = breaks(low, high);
  ends.push_back(high);
  Rational from = low;
  for (const Rational& to : ends) {
    if (from < to || low == high) require(require, from, to, 0);
    from = to;
  }
}

Rational Joint::value_of(const Rational& measure) const {
  switch (kind_) {
    case Kind::kHinge:
    case Kind::kFourBar:
      return axis_.turn_of_degrees(measure);
    case Kind::kSlider:
      return measure;
    default:
      break;
  }
  // On the arc between quaternions of one length, 90 degrees apart in rotation: s = sin a / (sin a + sin (45 - a)),
  // a being half the angle.
  const Integer quarter = floor_of(measure / 90);
  const Rational rest = measure - 90 * quarter;
  if (rest == 0) return quarter;
  const double half = nearest_double(rest) * M_PI / 360;
  const double s = std::sin(half) / (std::sin(half) + std::sin(M_PI / 4 - half));
  return quarter + exact_rational(s);
}

double Joint::measure_of(const Rational& value) const {
  if (kind_ == Kind::kHinge || kind_ == Kind::kFourBar) return axis_.degrees_of(value);
  if (kind_ == Kind::kSlider) return nearest_double(value);
  const Integer quarter = floor_of(value);
  const RigidMotion motion = quarter_of(axis_, direction_, 0);
  return 90 * quarter.get_d() + degrees_of(motion.quaternion(value - quarter));
}

std::vector<Rational> Joint::breaks(const Rational& low, const Rational& high) const {
  std::vector<Rational> result;
  if (kind_ == Kind::kSlider) return result;
  for (Integer quarter = ceiling_of(low); Rational(quarter) <= high; ++quarter) result.emplace_back(quarter);
  return result;
}

RigidPose Joint::pose(const Rational& value) const {
  NEF_ASSERT(is_algebraic());
  if (kind_ == Kind::kHinge) return {{0, 0, 0}, axis_.quaternion(value)};
  return {{value * direction_[0], value * direction_[1], value * direction_[2]}, {1, 0, 0, 0}};
}

std::array<Quaternion, 2> Joint::arc(const Rational& from, const Rational& to) const {
  if (kind_ == Kind::kSlider) return {Quaternion{1, 0, 0, 0}, Quaternion{1, 0, 0, 0}};
  // Both of the quarter's own chart, which axis_.quaternion leaves at its end.
  const Integer quarter = floor_of(from);
  const Quaternion begin = axis_.quaternion(quarter);
  const Quaternion middle = axis_.quaternion(quarter + Rational(1, 2));
  std::array<Quaternion, 2> ends;
  for (std::size_t k = 0; k < 4; ++k) {
    ends[0][k] = begin[k] + 2 * (from - quarter) * (middle[k] - begin[k]);
    ends[1][k] = begin[k] + 2 * (to - quarter) * (middle[k] - begin[k]);
  }
  return ends;
}

std::array<Surd3, 4> Joint::pose(const QuadraticRoot& value) const {
  NEF_ASSERT(is_algebraic());
  std::array<Surd3, 4> result;
  const Surd at = Surd::of(value);
  if (kind_ == Kind::kSlider) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[k][k] = Surd(1);
      result[3][k] = at * Surd(direction_[k]);
    }
    return result;
  }
  Integer quarter = floor_of(enclosure(value, 64)[0]);
  if (compare(value, Rational(quarter + 1)) >= 0) ++quarter;
  const std::array<Quaternion, 2> ends = arc(Rational(quarter), Rational(quarter + 1));
  std::array<Surd, 4> q;
  const Surd t = at - Surd(Rational(quarter));
  for (std::size_t k = 0; k < 4; ++k) q[k] = Surd(ends[0][k]) + t * Surd(ends[1][k] - ends[0][k]);
  const Surd length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const Surd two(2);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[i][i] = (q[0] * q[0] + q[i + 1] * q[i + 1] - q[j + 1] * q[j + 1] - q[k + 1] * q[k + 1]) / length;
    result[i][j] = two * (q[i + 1] * q[j + 1] - q[0] * q[k + 1]) / length;
    result[i][k] = two * (q[i + 1] * q[k + 1] + q[0] * q[j + 1]) / length;
  }
  return result;
}

Joint::Sweep Joint::sweep(const Rational& from, const Rational& to, double reach) const {
  Sweep sweep;
  if (bars_) {
    const std::optional<FourBar::Place> place = bars_->place(arc(from, to));
    if (place) {
      const Rational3& centre = bars_->centre();
      return sweep_of(*place, std::sqrt(nearest_double(dot(centre, centre))), reach);
    }
    sweep.all.wide = true;
    return sweep;
  }
  if (kind_ != Kind::kScrew) {
    const RigidMotion motion(pose(from), pose(to));
    const MotionCells cells(motion);
    sweep.all = cells.part(0, 1);
    sweep.middle = cells.pose(0.5);
    return sweep;
  }
  const Integer quarter = floor_of(from);
  const RigidMotion motion = quarter_of(axis_, direction_, quarter);
  const MotionCells cells(motion);
  const double a = nearest_double(from - quarter);
  const double b = nearest_double(to - quarter);
  sweep.all = cells.part(a, b);
  sweep.middle = cells.pose((a + b) / 2);
  sweep.middle_error = cells.position_error();
  return sweep;
}

Joint::Sweep Joint::sweep(const QuadraticRoot& value) const {
  constexpr unsigned kBits = 45;
  const std::array<Rational, 2> around = enclosure(value, kBits);
  return sweep(around[0], around[1], 0);
}

}  // namespace nef::planner
