// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/plane_finder.h"

namespace nef {
namespace {

// p - o up to a positive factor.
void difference(const PointTable& points, PointId p, PointId o, Integer3& out) {
  const IntegerView w = points.coordinate(o, 3);
  const IntegerView of_p = points.coordinate(p, 3);
  const bool same = mpz_cmp(w, of_p) == 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr d = out[i].get_mpz_t();
    if (same) {
      mpz_sub(d, points.coordinate(p, i), points.coordinate(o, i));
    } else {
      mpz_mul(d, points.coordinate(p, i), w);
      mpz_submul(d, points.coordinate(o, i), of_p);
    }
  }
}

}  // namespace

PlaneId PlaneFinder::through(PlaneTable& planes, const PointTable& points, const Integer3& normal, PointId o) {
  n_ = normal;
  return with_normal(planes, points, o);
}

PlaneId PlaneFinder::through(PlaneTable& planes, const PointTable& points, PointId o, PointId p, PointId q) {
  difference(points, p, o, u_);
  difference(points, q, o, v_);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    mpz_mul(n_[i].get_mpz_t(), u_[j].get_mpz_t(), v_[k].get_mpz_t());
    mpz_submul(n_[i].get_mpz_t(), u_[k].get_mpz_t(), v_[j].get_mpz_t());
  }
  if (is_zero(n_)) return PlaneId();
  return with_normal(planes, points, o);
}

// Short normals first: a common factor, mostly 1, would go through all that follows. The plane is w n.x + offset = 0, w
// being the point's denominator, and what w n and the offset have in common is a divisor of w.
PlaneId PlaneFinder::with_normal(PlaneTable& planes, const PointTable& points, PointId o) {
  mpz_ptr offset = offset_.get_mpz_t();
  mpz_set_ui(offset, 0);
  Integer& divisor = u_[0];
  mpz_gcd(divisor.get_mpz_t(), n_[0].get_mpz_t(), n_[1].get_mpz_t());
  mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), n_[2].get_mpz_t());
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr n = n_[i].get_mpz_t();
    if (divisor > 1) mpz_divexact(n, n, divisor.get_mpz_t());
    mpz_submul(offset, n, points.coordinate(o, i));
  }
  const IntegerView w = points.coordinate(o, 3);
  mpz_gcd(divisor.get_mpz_t(), w, offset);
  Integer& factor = u_[1];
  mpz_divexact(factor.get_mpz_t(), w, divisor.get_mpz_t());
  if (divisor > 1) mpz_divexact(offset, offset, divisor.get_mpz_t());
  if (factor > 1) {
    for (Integer& n : n_) mpz_mul(n.get_mpz_t(), n.get_mpz_t(), factor.get_mpz_t());
  }
  return planes.intern_primitive({n_[0].get_mpz_t(), n_[1].get_mpz_t(), n_[2].get_mpz_t(), offset});
}

}  // namespace nef
