// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/exact_point.h"

#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {

Rational3 point_between(const Rational3& a, const Rational3& b, const Rational& t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Rational3 mean_of(std::span<const Rational3> points) {
  Rational3 sum;
  for (const Rational3& point : points) sum = plus(sum, point);
  for (Rational& value : sum) value /= Rational(static_cast<unsigned long>(points.size()));
  return sum;
}

ExactPoint::ExactPoint(const Rational3& point) : known_(true) {
  Integer& w = homogeneous_[3];
  w = common_denominator(point);
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

Integer ExactPoint::exact_form(const PlaneTable& planes, PlaneId plane) const {
  const std::array<Integer, 4>& h = homogeneous();
  Integer sum;
  for (std::size_t i = 0; i < 4; ++i) mpz_addmul(sum.get_mpz_t(), planes.coefficient(plane, i), h[i].get_mpz_t());
  return sum;
}

int ExactSegment::exact_side(PlaneId plane, const SegmentParameter& t) const {
  if (!t.plane.valid()) return sgn((t.direction == 0 ? a_ : b_)->exact_form(*planes_, plane));
  const Integer numerator = a_->exact_form(*planes_, t.plane) * b_->exact_form(*planes_, plane) -
                            a_->exact_form(*planes_, plane) * b_->exact_form(*planes_, t.plane);
  return t.direction * sgn(numerator);
}

Rational ExactSegment::exact(const SegmentParameter& t) const {
  if (!t.plane.valid()) return Rational(t.direction);
  const Integer fa = a_->exact_form(*planes_, t.plane) * b_->homogeneous()[3];
  const Integer fb = b_->exact_form(*planes_, t.plane) * a_->homogeneous()[3];
  Rational result(fa, fa - fb);
  result.canonicalize();
  return result;
}

Rational3 ExactSegment::point(const Rational& t) const { return point_between(a_->rational(), b_->rational(), t); }

}  // namespace nef::planner
