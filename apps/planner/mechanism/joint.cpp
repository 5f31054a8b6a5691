// SPDX-License-Identifier: Apache-2.0
//
// Within a quarter, the quaternion of a turn is linear in it (turning/turn.h), so a hinge's cell is an arc with the
// value as its parameter. A screw's cell is the same arc with a segment that encloses its positions. A four-bar
// linkage's is the pose in the middle and a ball.
#include "apps/planner/mechanism/joint.h"

#include <cmath>

#include "apps/planner/mechanism/screw_contact.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

Rational3 times(const Rational3& v, const Rational& x) { return {v[0] * x, v[1] * x, v[2] * x}; }

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
  return kind_ == Kind::kSlider ? measure : axis_.turn_of_degrees(measure);
}

double Joint::measure_of(const Rational& value) const {
  return kind_ == Kind::kSlider ? nearest_double(value) : axis_.degrees_of(value);
}

std::vector<Rational> Joint::breaks(const Rational& low, const Rational& high) const {
  std::vector<Rational> result;
  if (kind_ == Kind::kSlider) return result;
  for (Integer quarter = ceiling_of(low); Rational(quarter) <= high; ++quarter) result.emplace_back(quarter);
  return result;
}

RigidPose Joint::pose(const Rational& value) const {
  NEF_ASSERT(has_products());
  switch (kind_) {
    case Kind::kHinge:
      return {{0, 0, 0}, axis_.quaternion(value)};
    case Kind::kScrew:
      return {times(direction_, quarters(value, kShareBits)[0]), axis_.quaternion(value)};
    default:
      return {times(direction_, value), {1, 0, 0, 0}};
  }
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
  NEF_ASSERT(has_products());
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
  if (kind_ != Kind::kScrew) return result;
  for (const ExactTurn& exact : exact_turns(quarter)) {
    if (compare(exact.turn, value) != 0) continue;
    for (std::size_t i = 0; i < 3; ++i) result[3][i] = Surd(Rational(exact.quarters * direction_[i]));
    return result;
  }
  NEF_ASSERT(false);
  return result;
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
  RigidPose begin = pose(from);
  RigidPose end = pose(to);
  if (kind_ == Kind::kScrew) {
    // Positions that enclose those of pose() too, which may be lower by 2^-100.
    constexpr unsigned kBits = kShareBits - 10;
    Rational margin(1);
    mpq_div_2exp(margin.get_mpq_t(), margin.get_mpq_t(), kBits);
    begin.position = times(direction_, quarters(from, kBits)[0] - margin);
    end.position = times(direction_, quarters(to, kBits)[1] + margin);
    const RigidPose middle = pose((from + to) / 2);
    sweep.middle = MotionCells(RigidMotion(middle, middle)).pose(0);
    sweep.middle_error = 0x1p-90 * to_vector(direction_).lpNorm<1>();
  }
  const RigidMotion motion(begin, end);
  const MotionCells cells(motion);
  sweep.all = cells.part(0, 1);
  if (kind_ != Kind::kScrew) sweep.middle = cells.pose(0.5);
  return sweep;
}

Joint::Sweep Joint::sweep(const QuadraticRoot& value) const {
  constexpr unsigned kBits = 45;
  const std::array<Rational, 2> around = enclosure(value, kBits);
  return sweep(around[0], around[1], 0);
}

}  // namespace nef::planner
