// SPDX-License-Identifier: Apache-2.0
//
// Angles about one axis whose rotations are rational.
#pragma once

#include <array>
#include <optional>

#include "nef/polyhedron.h"

namespace nef::planner {

/// An angle about a TurningAxis as a number of quarters plus a rest: q + t, q whole, 0 <= t < 1. Greater number,
/// greater angle; 4 is the full circle. About an axis of rational length (a coordinate axis, (1, 2, 2)) a quarter is 90
/// degrees and t the tangent of half of what is left. About any other one quarter turns have no rational rotation:
/// there, two quarters are a half turn, and the odd one begins a little off 90 degrees (TurningAxis says where).
using Turn = Rational;

/// The turn by full circles moved to be the least that is no less than `low`.
Turn moved_above(const Turn& turn, const Turn& low);

/// An axis of rotation through the origin, in a rational direction. With n the direction, scaled, and N = n n, which is
/// 1 if the direction has a rational length and near 1 otherwise, the rotations with rational entries are those by
/// angles whose half has the tangent s / w sqrt(N), s and w rational: those of the quaternions w + s n. Turns are these
/// angles in order: an even number q of quarters and t stand for q / 2 half turns and the half-tangent t sqrt(N), an
/// odd one begins where that ends and goes on by the half-tangent t / sqrt(N), so it ends at the next half turn.
class TurningAxis {
 public:
  /// Throws InputError for the zero vector.
  explicit TurningAxis(const Rational3& direction);

  /// The direction, scaled.
  [[nodiscard]] const Rational3& direction() const { return n_; }
  /// Its squared length.
  [[nodiscard]] const Rational& square() const { return square_; }

  /// The part of a vector across the axis.
  [[nodiscard]] Rational3 across(const Rational3& v) const;

  /// The rotation about the axis, counterclockwise seen from where the direction points to.
  [[nodiscard]] AffineMap rotation(const Turn& turn) const;
  /// The quaternion of that rotation, of any length: w, and the multiple of the direction in the other three.
  [[nodiscard]] std::array<Rational, 4> quaternion(const Turn& turn) const;
  /// M(p, q) of both rotations (rigid/rigid_motion.h), less than a half turn apart: it takes a point to where the
  /// tangents to its arc from a to b at both ends meet.
  [[nodiscard]] AffineMap between(const Turn& a, const Turn& b) const;
  /// The turn that takes one direction to another one, both seen along the axis, in [0, 4); nothing if it is not
  /// rational, or one of them lies in the axis.
  [[nodiscard]] std::optional<Turn> turn_between(const Rational3& from, const Rational3& to) const;

  /// The turn of `degrees`: exact for multiples of 180 (of 90, where a quarter is that), else the simplest within 1e-12
  /// of the rest.
  [[nodiscard]] Turn turn_of_degrees(const Rational& degrees) const;
  /// For people.
  [[nodiscard]] double degrees_of(const Turn& turn) const;

 private:
  /// Half an angle as the complex number w + s sqrt(-N), of any length.
  struct Half {
    Rational w;
    Rational s;
  };
  [[nodiscard]] Half half_of(const Turn& turn) const;

  Rational3 n_;
  Rational square_;
};

}  // namespace nef::planner
