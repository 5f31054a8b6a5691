// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/clearance/widest.h"

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

// Every facet has the origin on its inner side or in its plane.
bool sees_all_from_origin(const Polyhedron& robot) {
  const Complex& c = robot.complex();
  for (const Facet& facet : c.facets) {
    const int offset = mpz_sgn(mpz_srcptr(c.planes.coefficient(facet.plane, 3)));
    const bool inside_above = c.volumes[facet.volume_above].mark != 0;
    if (inside_above ? offset < 0 : offset > 0) return false;
  }
  return true;
}

}  // namespace

Polyhedron grown(const Polyhedron& robot, Growth growth, const Rational& size, const Monitor& monitor) {
  if (growth == Growth::kBox) {
    if (size == 0) return robot;
    minkowski::MinkowskiOptions options;
    options.monitor = monitor;
    return minkowski::minkowski_sum(robot, make_box({-size, -size, -size}, {size, size, size}, monitor), options);
  }
  if (!robot.is_regular() || !sees_all_from_origin(robot)) {
    throw InputError(
        "--widest: all of the robot must be visible from its reference point, or a smaller robot might not pass "
        "where a larger one does; move 'reference', or use --widest-box");
  }
  return transform(robot, AffineMap::scale({size, size, size}), monitor);
}

Widest find_widest(const Rational& first, const Rational& least, const Rational& precision,
                   const std::function<Verdict(const Rational&)>& verdict) {
  constexpr int kDoublings = 20;
  Widest result;
  // False where the search ends.
  const auto ask = [&](const Rational& size) {
    ++result.questions;
    switch (verdict(size)) {
      case Verdict::kPath:
        result.low = size;
        return true;
      case Verdict::kNone:
        result.high = size;
        return true;
      default:
        result.undecided = true;
        return false;
    }
  };
  if (!ask(first)) return result;
  Rational size = first;
  for (int i = 0; i < kDoublings && !result.high; ++i) {
    size = size == 0 ? Rational(1) : Rational(2 * size);
    if (!ask(size)) return result;
  }
  while (!result.low && size >= 2 * least) {
    size /= 2;
    if (!ask(size)) return result;
  }
  // However small `high` is, it is far from 0 by its own measure.
  const auto is_close = [&] {
    const Rational width = *result.high - *result.low;
    return width <= precision * *result.high || (*result.low == 0 && width <= least);
  };
  while (result.low && result.high && !is_close()) {
    const Rational quarter = (*result.high - *result.low) / 4;
    const Rational most = *result.low == 0 ? *result.high / 2 : Rational(*result.high - quarter);
    if (!ask(simplest_between(*result.low + quarter, most))) break;
  }
  return result;
}

}  // namespace nef::planner
