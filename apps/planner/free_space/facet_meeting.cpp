// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/facet_meeting.h"

#include <cmath>

#include "nef/complex/facet_plane.h"

namespace nef::planner {
namespace {

// The difference of two coordinates, and how far off it may be: what they are off themselves, and their rounding.
Approximation difference(double a, double a_error, double b, double b_error) {
  return {a - b, a_error + b_error + (std::fabs(a) + std::fabs(b)) * 0x1p-50 + 1e-300};
}

// The sign of the determinant of rows (a, b) and (c, d), or 0. Products are off by what their factors are, and some u.
int sign_of_determinant(const Approximation& a, const Approximation& b, const Approximation& c,
                        const Approximation& d) {
  const auto product_error = [](const Approximation& x, const Approximation& y) {
    return std::fabs(x.value) * y.error + std::fabs(y.value) * x.error + x.error * y.error +
           std::fabs(x.value * y.value) * 0x1p-50;
  };
  const double error = (product_error(a, d) + product_error(b, c)) * (1 + 0x1p-48) + 1e-300;
  return Approximation{a.value * d.value - b.value * c.value, error}.sign();
}

}  // namespace

// With forms f and g at the ends t = f / (f - g). If both were exact, t would be off by some u; their errors move it by
// at most the sum of the errors over what is surely left of the difference.
std::optional<RoughPoint> crossing_point(const Vector3d& from, const Vector3d& to, const Approximation& form_at_from,
                                         const Approximation& form_at_to) {
  const double span = std::fabs(form_at_from.value - form_at_to.value);
  const double error = 2 * (form_at_from.error + form_at_to.error);
  if (!(span > 4 * error)) return std::nullopt;
  const double t = form_at_from.value / (form_at_from.value - form_at_to.value);
  const double t_error = 2 * error / span + 0x1p-48;
  RoughPoint result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double along = to[i] - from[i];
    result.at[k] = from[i] + t * along;
    result.error[k] = std::fabs(along) * t_error + (std::fabs(from[i]) + std::fabs(to[i])) * 0x1p-48 + 1e-300;
  }
  return result;
}

// A ray from the point towards larger first coordinates crosses an odd number of edges iff the point is within the
// cycles. An edge surely behind the point, above or below the ray does not matter; any other must surely begin on one
// side of the ray and end on the other.
InFacet place_in_facet(const Complex& complex, const Facet& facet, const RoughPoint& point) {
  const PlaneAxes axes(complex.planes, facet.plane);
  const auto u = static_cast<std::size_t>(axes.first);
  const auto v = static_cast<std::size_t>(axes.second);
  bool inside = false;
  for (const std::uint32_t corner : complex.corners_of(facet)) {
    const HalfedgeId halfedge = complex.corner_halfedge(corner);
    const std::array<double, 3>& p = complex.points.approximate(point_of(complex.source(halfedge)));
    const std::array<double, 3>& q = complex.points.approximate(point_of(complex.target(halfedge)));
    const Approximation pv = difference(p[v], 0, point.at[v], point.error[v]);
    const Approximation qv = difference(q[v], 0, point.at[v], point.error[v]);
    const int p_side = pv.sign();
    const int q_side = qv.sign();
    if (p_side * q_side > 0) continue;
    const Approximation pu = difference(p[u], 0, point.at[u], point.error[u]);
    const Approximation qu = difference(q[u], 0, point.at[u], point.error[u]);
    if (pu.sign() < 0 && qu.sign() < 0) continue;
    if (p_side * q_side == 0) return InFacet::kUnsure;
    const int turn = sign_of_determinant(pu, pv, qu, qv);
    if (turn == 0) return InFacet::kUnsure;
    if (turn == q_side) inside = !inside;
  }
  return inside ? InFacet::kInside : InFacet::kOutside;
}

}  // namespace nef::planner
