// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/exact_point.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

constexpr double kUnit = 0x1p-53;

int sign_of(const Integer& value) { return sgn(value); }

}  // namespace

ExactPoint::ExactPoint(const Rational3& point) : known_(true) {
  Integer& w = homogeneous_[3];
  w = point[0].get_den();
  for (std::size_t i = 1; i < 3; ++i) mpz_lcm(w.get_mpz_t(), w.get_mpz_t(), point[i].get_den().get_mpz_t());
  for (std::size_t i = 0; i < 3; ++i) {
    homogeneous_[i] = point[i].get_num() * (w / point[i].get_den());
    approximate_[i] = nearest_double(point[i]);
  }
}

const std::array<Integer, 4>& ExactPoint::homogeneous() const {
  if (known_) return homogeneous_;
  const ExactPoint exact{
      Rational3{exact_rational(approximate_[0]), exact_rational(approximate_[1]), exact_rational(approximate_[2])}};
  homogeneous_ = exact.homogeneous_;
  known_ = true;
  return homogeneous_;
}

Rational3 ExactPoint::rational() const {
  if (from_doubles_) {
    return {exact_rational(approximate_[0]), exact_rational(approximate_[1]), exact_rational(approximate_[2])};
  }
  Rational3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = Rational(homogeneous_[i], homogeneous_[3]);
    result[i].canonicalize();
  }
  return result;
}

Approximation ExactPoint::form(const PlaneTable& planes, PlaneId plane) const {
  const std::array<double, 4>& n = planes.approximate(plane);
  const double t0 = n[0] * approximate_[0];
  const double t1 = n[1] * approximate_[1];
  const double t2 = n[2] * approximate_[2];
  // Relative to the sum of magnitudes: 4u for a coefficient, u for a coordinate, u for a product
  // and 3u for the sums make 9u; 16u leaves room for higher terms, the last one covers underflow.
  const double magnitude = std::fabs(t0) + std::fabs(t1) + std::fabs(t2) + std::fabs(n[3]);
  return {t0 + t1 + t2 + n[3], 16 * kUnit * magnitude + 1e-300};
}

Integer ExactPoint::exact_form(const PlaneTable& planes, PlaneId plane) const {
  const std::array<Integer, 4>& h = homogeneous();
  Integer sum;
  for (std::size_t i = 0; i < 4; ++i) mpz_addmul(sum.get_mpz_t(), planes.coefficient(plane, i), h[i].get_mpz_t());
  return sum;
}

int ExactPoint::side(const PlaneTable& planes, PlaneId plane) const {
  if (const int sign = form(planes, plane).sign(); sign != 0) return sign;
  return sign_of(exact_form(planes, plane));
}

SegmentParameter ExactSegment::fixed(int value) {
  SegmentParameter t;
  t.low = t.high = value;
  t.exact = Rational(value);
  return t;
}

SegmentParameter ExactSegment::crossing(PlaneId plane) const {
  SegmentParameter t;
  t.plane = plane;
  const Approximation fa = a_->form(*planes_, plane);
  const Approximation fb = b_->form(*planes_, plane);
  const double span = std::fabs(fa.value - fb.value);
  const double slack = fa.error + fb.error + 2 * kUnit * span;
  t.low = 0;
  t.high = 1;
  if (!(span > 2 * slack)) return t;  // the doubles say nothing
  // |fa| / |fa - fb| with each part known to its error; a relative 4u covers the rounding of both.
  t.low = std::max(0.0, (std::fabs(fa.value) - fa.error) / (span + slack) * (1 - 4 * kUnit));
  t.high = std::min(1.0, (std::fabs(fa.value) + fa.error) / (span - slack) * (1 + 4 * kUnit));
  return t;
}

const Rational& ExactSegment::exact(SegmentParameter& t) const {
  if (!t.exact) {
    const Integer fa = a_->exact_form(*planes_, t.plane) * b_->homogeneous()[3];
    const Integer fb = b_->exact_form(*planes_, t.plane) * a_->homogeneous()[3];
    t.exact = Rational(fa, fa - fb);
    t.exact->canonicalize();
  }
  return *t.exact;
}

int ExactSegment::side(PlaneId plane, SegmentParameter& t) const {
  if (t.plane.valid() && t.plane.row() == plane.row()) return 0;
  if (!t.plane.valid()) return sgn(*t.exact) == 0 ? a_->side(*planes_, plane) : b_->side(*planes_, plane);
  const Approximation fa = a_->form(*planes_, plane);
  const Approximation fb = b_->form(*planes_, plane);
  // The form is linear in t: between its values at both ends of the interval of t.
  const double at_low = fa.value + t.low * (fb.value - fa.value);
  const double at_high = fa.value + t.high * (fb.value - fa.value);
  const double error = 2 * (fa.error + fb.error) + 16 * kUnit * (std::fabs(fa.value) + std::fabs(fb.value));
  if (at_low > error && at_high > error) return 1;
  if (at_low < -error && at_high < -error) return -1;
  const Rational& exact_t = exact(t);
  const Integer ea = a_->exact_form(*planes_, plane) * b_->homogeneous()[3];
  const Integer eb = b_->exact_form(*planes_, plane) * a_->homogeneous()[3];
  const Integer scaled = ea * exact_t.get_den() + exact_t.get_num() * (eb - ea);
  return sgn(scaled);
}

Rational3 ExactSegment::point(const Rational& t) const {
  const Rational3 a = a_->rational();
  const Rational3 b = b_->rational();
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Rational3 ExactSegment::point(SegmentParameter& t) const { return point(exact(t)); }

}  // namespace nef::planner
