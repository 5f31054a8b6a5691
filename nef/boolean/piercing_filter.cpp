// SPDX-License-Identifier: Apache-2.0
//
// u = 2^-53. Doubles of planes and points are within 4u relative of the truth (predicates.cpp).
// Infinities and NaNs (infimaximal points, overflow) fail the comparisons that would decide.
#include "nef/boolean/piercing_filter.h"

#include <cmath>

namespace nef {
namespace {

struct Form {
  double low = 0;  ///< of the absolute value
  double high = 0;
};

// The form of a plane at a point, up to sign.
Form absolute_form(const std::array<double, 4>& n, const std::array<double, 3>& x) {
  const Approximation form = approximate_form(n, x);
  const double value = std::fabs(form.value);
  return {value > form.error ? value - form.error : 0.0, value + form.error};
}

}  // namespace

Box piercing_box(const PlaneTable& planes, PlaneId plane, const PointTable& points, PointId a, PointId b) {
  const std::array<double, 3>& x = points.approximate(a);
  const std::array<double, 3>& y = points.approximate(b);
  const Form at_a = absolute_form(planes.approximate(plane), x);
  const Form at_b = absolute_form(planes.approximate(plane), y);
  // The crossing is a + t (b - a), t = |form(a)| / (|form(a)| + |form(b)|), rising in the first and falling in
  // the second; three roundings each, 4u at most.
  const double from = at_a.low / (at_a.low + at_b.high) * (1 - 8 * kRoundingUnit);
  const double to = std::min(1.0, at_a.high / (at_a.high + at_b.low) * (1 + 8 * kRoundingUnit));
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = y[i] - x[i];
    const double p = x[i] + from * d;
    const double q = x[i] + to * d;
    // A point between the ends inherits at most their errors, 4u of the larger; d, product and sum
    // round by at most 2u + u + u of |x| + |y|: 8u in all, 16u is safe.
    const double margin = 16 * kRoundingUnit * (std::fabs(x[i]) + std::fabs(y[i])) + 1e-300;
    const bool known = margin < HUGE_VAL && from >= 0 && to <= 1;
    box.low[i] = known ? std::min(p, q) - margin : -HUGE_VAL;
    box.high[i] = known ? std::max(p, q) + margin : HUGE_VAL;
  }
  return box;
}

RoughParity::RoughParity(const Box& point, int first, int second)
    : first_(static_cast<std::size_t>(first)),
      second_(static_cast<std::size_t>(second)),
      low_{point.low[first_], point.low[second_]},
      high_{point.high[first_], point.high[second_]} {}

void RoughParity::add(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  if (!certain_) return;
  const auto error_of = [](double value) { return std::fabs(value) * (8 * kRoundingUnit) + 1e-300; };
  const double ef = std::max(error_of(a[first_]), error_of(b[first_]));
  const double es = std::max(error_of(a[second_]), error_of(b[second_]));
  // Beyond the point, where the ray does not go.
  if (std::min(a[first_], b[first_]) - ef > high_[0]) return;
  const int side_a = a[second_] - es > high_[1] ? 1 : (a[second_] + es < low_[1] ? -1 : 0);
  const int side_b = b[second_] - es > high_[1] ? 1 : (b[second_] + es < low_[1] ? -1 : 0);
  if (side_a == 0 || side_b == 0) {
    certain_ = false;
    return;
  }
  if (side_a == side_b) return;
  if (std::max(a[first_], b[first_]) + ef < low_[0]) {
    inside_ = !inside_;
    return;
  }
  const double pf = (low_[0] + high_[0]) / 2;
  const double ps = (low_[1] + high_[1]) / 2;
  const double uf = b[first_] - a[first_];
  const double us = b[second_] - a[second_];
  const double vf = pf - a[first_];
  const double vs = ps - a[second_];
  const double cross = uf * vs - us * vf;
  // Each difference is off by at most e: twice the error of an end, half the box, and roundings of
  // coordinates that the error of an end covers. Two products of such differences of at most `size`
  // are off by 2 (2 size e + e^2), and round by 4u size^2.
  const double e = 3 * std::max(ef, es) + std::max(high_[0] - low_[0], high_[1] - low_[1]);
  const double size = std::max({std::fabs(uf), std::fabs(us), std::fabs(vf), std::fabs(vs)});
  const double bound = 2 * (2 * size * e + e * e) + 8 * kRoundingUnit * size * size + 1e-300;
  if (!(std::fabs(cross) > bound) || !(std::fabs(cross) < HUGE_VAL)) {
    certain_ = false;
    return;
  }
  // cross / us is the first coordinate of the edge at the point's height minus the point's.
  if ((cross < 0) == (us > 0)) inside_ = !inside_;
}

}  // namespace nef
