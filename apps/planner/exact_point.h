// SPDX-License-Identifier: Apache-2.0
//
// Points and segments that are asked on which side of planes they lie: doubles first, integers
// where the doubles cannot tell.
#pragma once

#include <array>
#include <optional>

#include "nef/geometry/plane_table.h"
#include "nef/number/number.h"

namespace nef::planner {

/// A value known by a double and a bound on its error.
struct Approximation {
  double value = 0;
  double error = 0;
  /// The certain sign, or 0 if the bound does not exclude it.
  [[nodiscard]] int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
};

/// A fixed exact point. Integers are computed at the first question that needs them, so an
/// object belongs to one thread.
class ExactPoint {
 public:
  explicit ExactPoint(const Rational3& point);
  /// Doubles are rationals too; they must be finite.
  explicit ExactPoint(const std::array<double, 3>& point) : approximate_(point), from_doubles_(true) {}

  /// Doubles within 2^-53 relative of the truth.
  [[nodiscard]] const std::array<double, 3>& approximate() const { return approximate_; }
  [[nodiscard]] Rational3 rational() const;
  /// x, y, z, w with w > 0.
  [[nodiscard]] const std::array<Integer, 4>& homogeneous() const;

  /// The form of the unflipped plane, in the scale of PlaneTable::approximate. Planes with a part
  /// in R are not allowed.
  [[nodiscard]] Approximation form(const PlaneTable& planes, PlaneId plane) const;
  /// The exact form times w: an integer.
  [[nodiscard]] Integer exact_form(const PlaneTable& planes, PlaneId plane) const;
  /// The side of the unflipped plane: +1, 0, -1. Exact.
  [[nodiscard]] int side(const PlaneTable& planes, PlaneId plane) const;

 private:
  std::array<double, 3> approximate_{};
  bool from_doubles_ = false;
  mutable bool known_ = false;
  mutable std::array<Integer, 4> homogeneous_;
};

/// A parameter on a segment: 0, 1, or where the segment crosses a plane.
struct SegmentParameter {
  double low = 0;
  double high = 0;
  PlaneId plane;                  ///< invalid for 0 and 1
  std::optional<Rational> exact;  ///< computed on demand; always there without a plane
};

/// The segment from a to b, which must outlive it and differ.
class ExactSegment {
 public:
  ExactSegment(const PlaneTable& planes, const ExactPoint& a, const ExactPoint& b) : planes_(&planes), a_(&a), b_(&b) {}

  static SegmentParameter fixed(int value);
  /// Where the segment crosses the plane; its ends must lie strictly on different sides.
  [[nodiscard]] SegmentParameter crossing(PlaneId plane) const;
  /// The exact value of a parameter; kept in it.
  const Rational& exact(SegmentParameter& t) const;
  /// Side of the unflipped plane of the point at t. Exact.
  int side(PlaneId plane, SegmentParameter& t) const;
  /// The exact point at t.
  Rational3 point(SegmentParameter& t) const;
  [[nodiscard]] Rational3 point(const Rational& t) const;

 private:
  const PlaneTable* planes_;
  const ExactPoint* a_;
  const ExactPoint* b_;
};

}  // namespace nef::planner
