// SPDX-License-Identifier: Apache-2.0
//
// Filters. u = 2^-53 is the unit roundoff. Plane and point doubles carry a relative error of at
// most 4u (they are truncated by GMP, scaled by powers of two, and quotients round once more).
#include "nef/geometry/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/geometry/compare_points.h"
#include "nef/geometry/direction_error.h"
#include "nef/number/int128.h"

namespace nef {
namespace {

constexpr double kUnit = kRoundingUnit;

// Sign of constant + factor * R.
int sign_with_infimaximal(mpz_srcptr constant, mpz_srcptr factor) {
  const int sign = mpz_sgn(factor);
  return sign != 0 ? sign : mpz_sgn(constant);
}

int side_of_plane_exact(const PlaneTable& planes, PlaneId plane, const PointTable& points, PointId point) {
  std::array<std::int64_t, 5> n{};
  std::array<std::int64_t, 7> x{};
  if (kFastPaths && planes.small_coefficients(plane, n) && points.small_coordinates(point, x)) {
    // Four products below 2^124.
    Int128 constant = static_cast<Int128>(n[3]) * x[3];
    Int128 factor = static_cast<Int128>(n[4]) * x[3];
    for (std::size_t i = 0; i < 3; ++i) {
      constant += static_cast<Int128>(n[i]) * x[i];
      factor += static_cast<Int128>(n[i]) * x[4 + i];
    }
    return factor != 0 ? sign_of(factor) : sign_of(constant);
  }
  Integer constant;
  Integer factor;
  mpz_ptr c = constant.get_mpz_t();
  mpz_ptr r = factor.get_mpz_t();
  const std::array<IntegerView, 5> of_plane = planes.coefficients(plane);
  const std::array<IntegerView, 4> of_point = points.coordinates(point);
  mpz_mul(c, of_plane[3], of_point[3]);
  mpz_mul(r, of_plane[4], of_point[3]);
  for (std::size_t i = 0; i < 3; ++i) mpz_addmul(c, of_plane[i], of_point[i]);
  if (!points.finite(point)) {
    for (std::size_t i = 0; i < 3; ++i) mpz_addmul(r, of_plane[i], points.coordinate(point, 4 + i));
  }
  return sign_with_infimaximal(c, r);
}

// The sign of x / wp - y / wq for wp, wq > 0.
int compare_quotients(mpz_srcptr x, mpz_srcptr wp, mpz_srcptr y, mpz_srcptr wq) {
  const int sign = mpz_sgn(x);
  if (sign != mpz_sgn(y)) return sign > mpz_sgn(y) ? 1 : -1;
  if (sign == 0) return 0;
  Integer difference;
  mpz_ptr d = difference.get_mpz_t();
  mpz_mul(d, x, wq);
  mpz_submul(d, y, wp);
  return mpz_sgn(d);
}

int compare_coordinate_exact(const PointTable& points, PointId p, const PointTable& others, PointId q, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  std::array<std::int64_t, 7> a{};
  std::array<std::int64_t, 7> b{};
  if (kFastPaths && points.small_coordinates(p, a) && others.small_coordinates(q, b)) {
    const auto difference = [&](std::size_t i) {
      return static_cast<Int128>(a[i]) * b[3] - static_cast<Int128>(b[i]) * a[3];
    };
    const int sign = sign_of(difference(4 + k));
    return sign != 0 ? sign : sign_of(difference(k));
  }
  const IntegerView wp = points.coordinate(p, 3);
  const IntegerView wq = others.coordinate(q, 3);
  // The part in R decides first.
  const int sign = compare_quotients(points.coordinate(p, 4 + k), wp, others.coordinate(q, 4 + k), wq);
  return sign != 0 ? sign : compare_quotients(points.coordinate(p, k), wp, others.coordinate(q, k), wq);
}

}  // namespace

int side_of_plane(const PlaneTable& planes, PlaneId plane, const PointTable& points, PointId point,
                  const Monitor& monitor) {
  const int sign = sign_by_ladder(approximate_form(planes.approximate(plane), points.approximate(point)), monitor,
                                  [&] { return side_of_plane_exact(planes, plane, points, point); });
  return plane.flipped() ? -sign : sign;
}

int compare_coordinate(const PointTable& points, PointId p, PointId q, int axis, const Monitor& monitor) {
  return p == q ? 0 : compare_coordinate(points, p, points, q, axis, monitor);
}

int compare_coordinate(const PointTable& points, PointId p, const PointTable& others, PointId q, int axis,
                       const Monitor& monitor) {
  const auto k = static_cast<std::size_t>(axis);
  return sign_by_ladder(approximate_difference(points.approximate(p)[k], others.approximate(q)[k]), monitor,
                        [&] { return compare_coordinate_exact(points, p, others, q, axis); });
}

int compare_lexicographic(const PointTable& points, PointId p, PointId q, const Monitor& monitor) {
  for (int axis = 0; axis < 3; ++axis) {
    if (const int sign = compare_coordinate(points, p, q, axis, monitor); sign != 0) return sign;
  }
  return 0;
}

Direction Direction::normal(const PlaneTable& planes, PlaneId plane) {
  Direction result;
  result.planes_ = &planes;
  result.p = plane;
  result.negative_ = plane.flipped();
  const std::array<double, 4>& n = planes.approximate(plane);
  for (std::size_t i = 0; i < 3; ++i) result.approximate[i] = plane.flipped() ? -n[i] : n[i];
  result.error = 4 * kUnit;
  return result;
}

Direction Direction::cross(const PlaneTable& planes, PlaneId p, PlaneId q) {
  Direction result;
  result.planes_ = &planes;
  result.p = p;
  result.q = q;
  result.negative_ = p.flipped() != q.flipped();
  const std::array<double, 4>& a = planes.approximate(p);
  const std::array<double, 4>& b = planes.approximate(q);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result.approximate[i] = a[j] * b[k] - a[k] * b[j];
    largest = std::max(largest, std::fabs(result.approximate[i]));
  }
  // Where the error is not small beside the vector itself (planes that are nearly parallel), the integers are worth
  // their cost at once.
  if (largest > kLeastCross) {
    const double scale = (result.negative_ ? -1.0 : 1.0) / largest;
    for (double& value : result.approximate) value *= scale;
    result.error = (kCrossError + 2 * kUnit) / largest;
    return result;
  }
  static_cast<void>(result.integers());
  result.set_approximation_from_integers();
  return result;
}

Direction Direction::exact(const Integer& x, const Integer& y, const Integer& z) {
  Direction result;
  result.known_ = true;
  result.integers_ = {x, y, z};
  result.set_approximation_from_integers();
  return result;
}

Direction Direction::cross(const Direction& u, const Direction& v) {
  const Integer3& a = u.integers();
  const Integer3& b = v.integers();
  return exact(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

Direction Direction::negated() const {
  Direction result = *this;
  for (double& value : result.approximate) value = -value;
  if (known_) {
    for (Integer& value : result.integers_) mpz_neg(value.get_mpz_t(), value.get_mpz_t());
  }
  if (q.valid()) {
    std::swap(result.p, result.q);  // q x p is the other direction already
  } else {
    result.negative_ = !negative_;
    if (p.valid()) result.p = p.opposite();
  }
  return result;
}

bool Direction::is_zero() const {
  const Integer3& v = integers();
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

const Integer3& Direction::integers() const& {
  if (known_) return integers_;
  NEF_ASSERT(planes_ != nullptr);
  const std::array<IntegerView, 5> a = planes_->coefficients(p);
  const std::array<IntegerView, 5> b = planes_->coefficients(q.valid() ? q : p);
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr out = integers_[i].get_mpz_t();
    if (!q.valid()) {
      mpz_set(out, a[i]);
    } else {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      mpz_mul(out, a[j], b[k]);
      mpz_submul(out, a[k], b[j]);
    }
    if (negative_) mpz_neg(out, out);
  }
  known_ = true;
  return integers_;
}

Integer3 Direction::integers() && { return std::as_const(*this).integers(); }

void Direction::set_approximation_from_integers() {
  std::array<long, 3> exponent{};
  long top = std::numeric_limits<long>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    approximate[i] = mpz_get_d_2exp(&exponent[i], integers_[i].get_mpz_t());
    if (approximate[i] != 0) top = std::max(top, exponent[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (approximate[i] == 0) continue;
    const long shift = exponent[i] - top;
    approximate[i] = shift < -1000 ? 0.0 : std::ldexp(approximate[i], static_cast<int>(shift));
  }
  error = 4 * kUnit;
}

namespace {

mpz_srcptr at(const Direction& v, std::size_t i) { return v.integers()[i].get_mpz_t(); }

// out = (v x w)[i]
void cross_component(mpz_ptr out, const Direction& v, const Direction& w, std::size_t i) {
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  mpz_mul(out, at(v, j), at(w, k));
  mpz_submul(out, at(v, k), at(w, j));
}

}  // namespace

int sign_of_dot(const Direction& u, const Direction& v, const Monitor& monitor) {
  const double value =
      u.approximate[0] * v.approximate[0] + u.approximate[1] * v.approximate[1] + u.approximate[2] * v.approximate[2];
  // Components are at most 1: a component's error e moves the sum by at most 3e (both at once by
  // the product of errors, far below), rounding by 3 products and 2 sums, under 8u.
  return sign_by_ladder({value, 3.1 * (u.error + v.error) + 16 * kUnit}, monitor, [&] {
    Integer sum;
    mpz_ptr s = sum.get_mpz_t();
    mpz_mul(s, at(u, 0), at(v, 0));
    mpz_addmul(s, at(u, 1), at(v, 1));
    mpz_addmul(s, at(u, 2), at(v, 2));
    return mpz_sgn(s);
  });
}

int sign_of_determinant(const Direction& u, const Direction& v, const Direction& w, const Monitor& monitor) {
  const std::array<double, 3>& a = u.approximate;
  const std::array<double, 3>& b = v.approximate;
  const std::array<double, 3>& c = w.approximate;
  const double value =
      a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  // Components are at most 1, cofactors at most 2: an error e in one vector moves the value by at
  // most 6e; rounding: 6 terms of 3 operations and 5 sums, under 40u.
  return sign_by_ladder({value, 6.2 * (u.error + v.error + w.error) + 64 * kUnit}, monitor, [&] {
    Integer sum;
    Integer component;
    mpz_ptr s = sum.get_mpz_t();
    mpz_ptr t = component.get_mpz_t();
    for (std::size_t i = 0; i < 3; ++i) {
      cross_component(t, v, w, i);
      mpz_addmul(s, at(u, i), t);
    }
    return mpz_sgn(s);
  });
}

bool same_direction(const Direction& u, const Direction& v, const Monitor& monitor) {
  if (u.p.valid() && u.p == v.p && u.q.valid() && u.q == v.q) {
    monitor.count_identity();
    return true;
  }
  // Both have largest component about 1 in max norm, but are scaled differently only within the
  // rounding of that; compare after a normalization that the errors dominate.
  double lu = 0;
  double lv = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    lu = std::max(lu, std::fabs(u.approximate[i]));
    lv = std::max(lv, std::fabs(v.approximate[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    // Each side is within (error of component + error of the norm, relative) of its truth.
    const double difference = u.approximate[i] / lu - v.approximate[i] / lv;
    if (kFastPaths && std::fabs(difference) > 2.1 * (u.error / lu + v.error / lv) + 16 * kUnit) {
      monitor.count_filter();
      return false;
    }
  }
  monitor.count_exact();
  Integer component;
  mpz_ptr t = component.get_mpz_t();
  for (std::size_t i = 0; i < 3; ++i) {
    cross_component(t, u, v, i);
    if (mpz_sgn(t) != 0) return false;
  }
  return sign_of_dot(u, v, monitor) > 0;
}

int side_of_circle(const PlaneTable& planes, PlaneId plane, const Direction& direction, const Monitor& monitor) {
  if (direction.q.valid() && (direction.p.row() == plane.row() || direction.q.row() == plane.row())) {
    monitor.count_identity();
    return 0;
  }
  return sign_of_dot(Direction::normal(planes, plane), direction, monitor);
}

int orientation_on_circle(const PlaneTable& planes, PlaneId plane, const Direction& u, const Direction& v,
                          const Monitor& monitor) {
  return sign_of_determinant(Direction::normal(planes, plane), u, v, monitor);
}

int orientation_around(const PlaneTable& planes, const Direction& d, PlaneId plane1, PlaneId plane2,
                       const Monitor& monitor) {
  if (plane1.row() == plane2.row()) {
    monitor.count_identity();
    return 0;
  }
  return sign_of_determinant(d, Direction::normal(planes, plane1), Direction::normal(planes, plane2), monitor);
}

}  // namespace nef
