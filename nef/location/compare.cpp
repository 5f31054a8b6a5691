// SPDX-License-Identifier: Apache-2.0
#include "nef/location/compare.h"

namespace nef {
namespace {

int compare_exact(const PointRef& p, const PointRef& q, std::size_t axis) {
  Integer difference;
  mpz_ptr d = difference.get_mpz_t();
  const IntegerView wp = p.coordinate(3);
  const IntegerView wq = q.coordinate(3);
  // The factor of R decides, the constant part only where the factors agree.
  mpz_mul(d, p.coordinate(4 + axis), wq);
  mpz_submul(d, q.coordinate(4 + axis), wp);
  if (mpz_sgn(d) != 0) return mpz_sgn(d);
  mpz_mul(d, p.coordinate(axis), wq);
  mpz_submul(d, q.coordinate(axis), wp);
  return mpz_sgn(d);
}

}  // namespace

int compare_coordinate(const PointRef& p, const PointRef& q, int axis, const Monitor& monitor) {
  if (p.table == q.table) return compare_coordinate(*p.table, p.id, q.id, axis, monitor);
  const auto k = static_cast<std::size_t>(axis);
  return sign_by_ladder(approximate_difference(p.approximate()[k], q.approximate()[k]), monitor,
                        [&] { return compare_exact(p, q, k); });
}

bool same_point(const PointRef& p, const PointRef& q, const Monitor& monitor) {
  for (int axis = 0; axis < 3; ++axis) {
    if (compare_coordinate(p, q, axis, monitor) != 0) return false;
  }
  return true;
}

}  // namespace nef
