// SPDX-License-Identifier: Apache-2.0
//
// Points and segments that are asked on which side of planes they lie: doubles first, integers
// where the doubles cannot tell.
#pragma once

#include <array>
#include <cmath>

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
  [[nodiscard]] Approximation form(const PlaneTable& planes, PlaneId plane) const {
    const std::array<double, 4>& n = planes.approximate(plane);
    const double t0 = n[0] * approximate_[0];
    const double t1 = n[1] * approximate_[1];
    const double t2 = n[2] * approximate_[2];
    // Relative to the sum of magnitudes: 4u for a coefficient, u for a coordinate, u for a product
    // and 3u for the sums make 9u; 16u leaves room for higher terms, the last one covers underflow.
    const double magnitude = std::fabs(t0) + std::fabs(t1) + std::fabs(t2) + std::fabs(n[3]);
    return {t0 + t1 + t2 + n[3], 16 * 0x1p-53 * magnitude + 1e-300};
  }
  /// The exact form times w: an integer.
  [[nodiscard]] Integer exact_form(const PlaneTable& planes, PlaneId plane) const;
  /// The side of the unflipped plane: +1, 0, -1. Exact.
  [[nodiscard]] int side(const PlaneTable& planes, PlaneId plane) const {
    if (const int sign = form(planes, plane).sign(); sign != 0) return sign;
    return sgn(exact_form(planes, plane));
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
    if (const int sign = here.sign(); sign != 0) return sign;
    return exact_side(forms.plane, t);
  }
  if (t.plane.row() == forms.plane.row()) return 0;
  // With q the form of t's plane and p that of the asked one: p at t is (q(a) p(b) - p(a) q(b)) / (q(a) - q(b)), and
  // the denominator has the sign of q(a). The error of the numerator is that of its factors, and 4u of the products
  // for its own rounding; the factor covers the rounding of the bound itself, the last term underflow.
  const double plus = t.at_a.value * forms.at_b.value;
  const double minus = forms.at_a.value * t.at_b.value;
  const double size_plus = std::fabs(t.at_a.value) * forms.at_b.error + std::fabs(forms.at_b.value) * t.at_a.error +
                           t.at_a.error * forms.at_b.error;
  const double size_minus = std::fabs(forms.at_a.value) * t.at_b.error + std::fabs(t.at_b.value) * forms.at_a.error +
                            forms.at_a.error * t.at_b.error;
  const double error =
      (size_plus + size_minus + 4 * 0x1p-53 * (std::fabs(plus) + std::fabs(minus))) * (1 + 0x1p-48) + 1e-300;
  const double value = plus - minus;
  if (value > error) return t.direction;
  if (value < -error) return -t.direction;
  return exact_side(forms.plane, t);
}

}  // namespace nef::planner
