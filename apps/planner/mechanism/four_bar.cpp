// SPDX-License-Identifier: Apache-2.0
//
// The second pin is where two circles meet: about the first pin, which the crank takes along an arc, and about the
// rocker's pivot. The arc of a point is a rational curve in the hull of three points (rigid/rigid_motion.h), so the
// coordinates of the first pin are between the least and the largest of theirs; everything else follows in intervals.
// These are narrow for one angle of the crank, and wide for an arc; so from the arc only speeds are taken. Let the
// crank turn by 1. Then its pin moves by v, across the crank, the coupler u turns by w with (v + w Ju) r = 0, r being
// the rocker and J the quarter turn, since the rocker keeps its length, and the rocker turns by w with (w Jr - v) u =
// 0.
#include "apps/planner/mechanism/four_bar.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// A nearest double is off by 2^-53 of the number, or by less than the smallest number that is normal.
Interval interval_of(const Rational& x) {
  const double rounded = nearest_double(x);
  return Interval::around(rounded, 0x1p-53 * std::fabs(rounded) + 0x1p-1022);
}

Interval interval_around(const Interval& a, const Interval& b) {
  return {std::min(a.low(), b.low()), std::max(a.high(), b.high())};
}

Interval square_of(const Interval& x) {
  const Interval square = x * x;
  return {std::max(square.low(), 0.0), square.high()};
}

}  // namespace

FourBar::FourBar(const TurningAxis& axis, const Rational3& rocker_pivot, const std::array<Rational3, 2>& pins,
                 Link link)
    : axis_(axis),
      link_(link),
      along_(axis.across(rocker_pivot)),
      aside_(cross(axis.direction(), along_)),
      pin_(axis.across(pins[0])),
      pivot_(along_) {
  const Rational3 coupler = minus(axis.across(pins[1]), pin_);
  const Rational3 rocker = minus(axis.across(pins[1]), pivot_);
  for (const Rational3& bar : {along_, pin_, coupler, rocker}) {
    if (is_zero(bar)) throw InputError("a bar of a four-bar linkage has no length across the axis");
  }
  const Rational frame = dot(along_, along_);
  coupler_ = dot(coupler, coupler) / frame;
  rocker_ = dot(rocker, rocker) / frame;
  side_ = sgn(dot(cross(minus(pivot_, pin_), coupler), axis.direction()));
  if (side_ == 0) {
    throw InputError(
        "coupler and rocker of a four-bar linkage are in one line at value 0, so it is not known to which side they go "
        "on");
  }
  coupler_at_0_ = flat(coupler);
  rocker_at_0_ = flat(rocker);
}

FourBar::Flat FourBar::flat(const Rational3& v) const {
  const Rational frame = dot(along_, along_);
  // The length of `aside_` is that of the frame times that of the axis' direction.
  return {interval_of(dot(v, along_) / frame), interval_of(dot(v, aside_) / frame) / sqrt(interval_of(axis_.square()))};
}

std::array<std::array<Interval, 3>, 3> FourBar::turn_between(const Flat& from, const Flat& to,
                                                             const Interval& square) const {
  const Interval cosine = (from.x * to.x + from.y * to.y) / square;
  const Interval sine = (from.x * to.y - from.y * to.x) / square;
  const Rational3& n = axis_.direction();
  const Interval length = sqrt(interval_of(axis_.square()));
  std::array<std::array<Interval, 3>, 3> turn;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Interval kept = interval_of(n[i] * n[j] / axis_.square());
      const Interval one = i == j ? 1 : 0;
      turn[i][j] = kept + cosine * (one - kept);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Interval part = sine * (interval_of(n[(i + 2) % 3]) / length);
    turn[i][j] = turn[i][j] - part;
    turn[j][i] = turn[j][i] + part;
  }
  return turn;
}

Rational3 FourBar::turned_pin(const Quaternion& p, const Quaternion& q) const {
  const Matrix3 m = rotation_between(p, q);
  return {dot(m[0], pin_), dot(m[1], pin_), dot(m[2], pin_)};
}

std::optional<FourBar::Bars> FourBar::bars(const std::array<Quaternion, 2>& arc) const {
  Bars result;
  result.pin = flat(turned_pin(arc[0], arc[0]));
  for (const Quaternion& first : arc) {
    const Flat at = flat(turned_pin(first, arc[1]));
    result.pin = {interval_around(result.pin.x, at.x), interval_around(result.pin.y, at.y)};
  }
  // From the pin to the rocker's pivot; the second pin is at a part of this way, and aside of it.
  const Flat way{Interval(1) - result.pin.x, -result.pin.y};
  const Interval square = square_of(way.x) + square_of(way.y);
  if (!(square.low() > 0)) return std::nullopt;
  const Interval coupler = interval_of(coupler_);
  const Interval part = (coupler - interval_of(rocker_) + square) / (Interval(2) * square);
  const Interval aside_square = coupler / square - square_of(part);
  if (!(aside_square.low() > 0)) return std::nullopt;
  const Interval aside = Interval(side_) * sqrt(aside_square);
  const auto bar = [&](const Interval& share) {
    return Flat{share * way.x - aside * way.y, share * way.y + aside * way.x};
  };
  result.coupler = bar(part);
  result.rocker = bar(part - Interval(1));
  return result;
}

std::optional<FourBar::Place> FourBar::place(const std::array<Quaternion, 2>& arc) const {
  Quaternion middle;
  for (std::size_t k = 0; k < 4; ++k) middle[k] = (arc[0][k] + arc[1][k]) / 2;
  const std::optional<Bars> all = bars(arc);
  const std::optional<Bars> at = bars({middle, middle});
  if (!all || !at) return std::nullopt;
  const bool is_coupler = link_ == Link::kCoupler;
  Place result;
  result.turn = is_coupler ? turn_between(coupler_at_0_, at->coupler, interval_of(coupler_))
                           : turn_between(rocker_at_0_, at->rocker, interval_of(rocker_));
  const Rational3 there = is_coupler ? turned_pin(middle, middle) : pivot_;
  for (std::size_t i = 0; i < 3; ++i) {
    Interval turned;
    for (std::size_t j = 0; j < 3; ++j) turned += result.turn[i][j] * interval_of(centre()[j]);
    result.shift[i] = interval_of(there[i]) - turned;
  }
  // An angle of less than a half turn is at most pi / 2 times the chord of its unit circle.
  const Interval radius = sqrt(interval_of(dot(pin_, pin_)));
  Interval angle;
  for (const Quaternion& end : arc) {
    const Rational3 chord = minus(turned_pin(end, end), turned_pin(middle, middle));
    angle = interval_around(angle, Interval(1.5708) * sqrt(interval_of(dot(chord, chord))) / radius);
  }
  const Flat speed{-all->pin.y, all->pin.x};
  const auto product = [](const Flat& a, const Flat& b) { return a.x * b.x + a.y * b.y; };
  const auto across = [](const Flat& a) { return Flat{-a.y, a.x}; };
  const Interval turn = is_coupler ? product(speed, all->rocker) / product(across(all->coupler), all->rocker)
                                   : product(speed, all->coupler) / product(across(all->rocker), all->coupler);
  result.way = is_coupler ? (radius * angle).high() : 0;
  result.turned = (interval_around(turn, -turn) * angle).high();
  if (!std::isfinite(result.turned)) return std::nullopt;
  return result;
}

}  // namespace nef::planner
