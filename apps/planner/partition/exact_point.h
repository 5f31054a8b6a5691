// SPDX-License-Identifier: Apache-2.0
//
// Points and segments that are asked on which side of planes they lie: doubles first, integers
// where the doubles cannot tell.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "nef/geometry/plane_table.h"
#include "nef/geometry/predicates.h"
#include "nef/number/approximation.h"
#include "nef/number/number.h"

namespace nef::planner {

/// The point a + t (b - a).
Rational3 point_between(const Rational3& a, const Rational3& b, const Rational& t);

/// The mean of some points, of which there is one at least.
Rational3 mean_of(std::span<const Rational3> points);

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
  [[nodiscard]] Approximation form(const PlaneTable& planes, PlaneId plane) const {
    return approximate_form(planes.approximate(plane), approximate_);
  }
  /// The exact form times w: an integer.
  [[nodiscard]] Integer exact_form(const PlaneTable& planes, PlaneId plane) const;
  /// The side of the unflipped plane: +1, 0, -1. Exact.
  [[nodiscard]] int side(const PlaneTable& planes, PlaneId plane) const {
    return sign_by_ladder(form(planes, plane), {}, [&] { return sgn(exact_form(planes, plane)); });
  }

 private:
  std::array<double, 3> approximate_{};
  bool from_doubles_ = false;
  mutable bool known_ = false;
  mutable std::array<Integer, 4> homogeneous_;
};

/// A parameter on a segment: 0, 1, or where the segment crosses a plane, known by the plane's form at both ends.
/// Nothing is computed before it is needed, and no division ever for a sign.
struct SegmentParameter {
  PlaneId plane;      ///< invalid for 0 and 1
  int direction = 0;  ///< without a plane: 0 or 1. Else the form's sign at a, opposite to that at b
  Approximation at_a;
  Approximation at_b;
};

/// The segment from a to b, which must outlive it and differ.
class ExactSegment {
 public:
  ExactSegment(const PlaneTable& planes, const ExactPoint& a, const ExactPoint& b) : planes_(&planes), a_(&a), b_(&b) {}

  /// The parameter 0 or 1.
  static SegmentParameter fixed(int value) { return {PlaneId{}, value, {}, {}}; }

  /// A plane with the doubles of its form at both ends; they serve all parameters that are asked about it.
  struct PlaneForms {
    PlaneId plane;
    Approximation at_a;
    Approximation at_b;
  };
  [[nodiscard]] PlaneForms forms(PlaneId plane) const {
    return {plane, a_->form(*planes_, plane), b_->form(*planes_, plane)};
  }
  /// Where the segment crosses the plane; `sign_at_a` is that of the form, which changes along the segment.
  static SegmentParameter crossing(const PlaneForms& forms, int sign_at_a) {
    return {forms.plane, sign_at_a, forms.at_a, forms.at_b};
  }
  /// Side of the unflipped plane of the point at t: +1, 0, -1. Exact.
  [[nodiscard]] int side(const PlaneForms& forms, const SegmentParameter& t) const;

  /// The exact value of a parameter.
  [[nodiscard]] Rational exact(const SegmentParameter& t) const;
  /// The exact point at t.
  [[nodiscard]] Rational3 point(const Rational& t) const;

 private:
  [[nodiscard]] int exact_side(PlaneId plane, const SegmentParameter& t) const;

  const PlaneTable* planes_;
  const ExactPoint* a_;
  const ExactPoint* b_;
};

inline int ExactSegment::side(const PlaneForms& forms, const SegmentParameter& t) const {
  if (!t.plane.valid()) {
    const Approximation& here = t.direction == 0 ? forms.at_a : forms.at_b;
    return sign_by_ladder(here, {}, [&] { return exact_side(forms.plane, t); });
  }
  if (t.plane.row() == forms.plane.row()) return 0;
  // With q the form of t's plane and p that of the asked one: p at t is (q(a) p(b) - p(a) q(b)) / (q(a) - q(b)), and
  // the denominator has the sign of q(a).
  const Approximation numerator = t.at_a * forms.at_b - forms.at_a * t.at_b;
  return sign_by_ladder(t.direction > 0 ? numerator : -numerator, {}, [&] { return exact_side(forms.plane, t); });
}

}  // namespace nef::planner
