// SPDX-License-Identifier: Apache-2.0
//
// A planar four-bar linkage: where its coupler or its rocker is while the crank turns, enclosed in intervals.
#pragma once

#include <array>
#include <optional>

#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/turning/turn.h"
#include "nef/number/interval.h"

namespace nef::planner {

/// Four bars in a plane across an axis: the frame, which stays, the crank, the coupler and the rocker. Crank and
/// coupler meet at the first pin, coupler and rocker at the second one; the rocker turns about the second pivot.
class FourBar {
 public:
  enum class Link : std::uint8_t { kCoupler, kRocker };

  /// Coordinates are those in which the crank's pivot is the origin, the pins those at the crank's value 0. Where
  /// points are along the axis does not matter. Throws InputError if a bar has no length, or if coupler and rocker lie
  /// in one line, so that they may go on to either side.
  FourBar(const TurningAxis& axis, const Rational3& rocker_pivot, const std::array<Rational3, 2>& pins, Link link);

  /// In the middle of an arc of the crank a point v of the link is at turn v + shift. Elsewhere on the arc it is no
  /// farther from there than way + turned * distance, if it is no farther than that from the axis about which the link
  /// turns, which goes through centre() at the crank's value 0.
  struct Place {
    std::array<std::array<Interval, 3>, 3> turn;
    std::array<Interval, 3> shift;
    double way = 0;
    double turned = 0;
  };
  /// The crank's pin or the rocker's pivot, at the crank's value 0.
  [[nodiscard]] const Rational3& centre() const { return link_ == Link::kCoupler ? pin_ : pivot_; }
  /// Where the link is for all rotations of the crank on an arc of quaternions that is less than a half turn long;
  /// nothing unless it is known that the bars meet all the time, and that coupler and rocker are never in one line.
  [[nodiscard]] std::optional<Place> place(const std::array<Quaternion, 2>& arc) const;

 private:
  // In the plane, in parts of the frame: the crank's pivot is 0, the rocker's (1, 0).
  struct Flat {
    Interval x;
    Interval y;
  };
  [[nodiscard]] Flat flat(const Rational3& v) const;
  // The bars while the crank is on an arc.
  struct Bars {
    Flat pin;      // of the crank
    Flat coupler;  // from pin to pin
    Flat rocker;   // from the pivot to the second pin
  };
  [[nodiscard]] std::optional<Bars> bars(const std::array<Quaternion, 2>& arc) const;
  [[nodiscard]] Rational3 turned_pin(const Quaternion& p, const Quaternion& q) const;
  // The rotation about the axis that takes one vector to another one of the same length.
  [[nodiscard]] std::array<std::array<Interval, 3>, 3> turn_between(const Flat& from, const Flat& to,
                                                                    const Interval& square) const;

  TurningAxis axis_;
  Link link_;
  Rational3 along_;   // the frame
  Rational3 aside_;   // across it, times the length of the axis' direction
  Rational3 pin_;     // crank and coupler at value 0
  Rational3 pivot_;   // of the rocker
  Rational coupler_;  // squares of lengths in parts of the frame's
  Rational rocker_;
  int side_ = 1;       // of the second pin, seen from the first one to the rocker's pivot
  Flat coupler_at_0_;  // from pin to pin
  Flat rocker_at_0_;   // from the pivot to the second pin
};

}  // namespace nef::planner
