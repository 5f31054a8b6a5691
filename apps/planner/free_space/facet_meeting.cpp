// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/free_space/facet_meeting.h"

#include <cmath>

#include "nef/complex/facet_plane.h"

namespace nef::planner {
namespace {

// A coordinate of a vertex or of a given point, which is within 4u of the truth, or within 2^-1074 where it is tiny.
Approximation coordinate(double value) { return {value, 4 * kRoundingUnit * std::fabs(value) + 1e-300}; }

}  // namespace

// With forms f and g at the ends t = f / (f - g).
RoughPoint crossing_point(const Vector3d& from, const Vector3d& to, const Approximation& form_at_from,
                          const Approximation& form_at_to) {
  const Approximation t = form_at_from / (form_at_from - form_at_to);
  RoughPoint result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    result[k] = coordinate(from[i]) + t * (coordinate(to[i]) - coordinate(from[i]));
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
  for (const SHalfedgeId corner : complex.corners_of(facet)) {
    const HalfedgeId halfedge = complex.corner_halfedge(corner);
    const std::array<double, 3>& p = complex.points.approximate(point_of(complex.source(halfedge)));
    const std::array<double, 3>& q = complex.points.approximate(point_of(complex.target(halfedge)));
    const Approximation pv = coordinate(p[v]) - point[v];
    const Approximation qv = coordinate(q[v]) - point[v];
    const int p_side = pv.sign().value_or(0);
    const int q_side = qv.sign().value_or(0);
    if (p_side * q_side > 0) continue;
    const Approximation pu = coordinate(p[u]) - point[u];
    const Approximation qu = coordinate(q[u]) - point[u];
    if (pu.sign().value_or(0) < 0 && qu.sign().value_or(0) < 0) continue;
    if (p_side * q_side == 0) return InFacet::kUnsure;
    const int turn = (pu * qv - pv * qu).sign().value_or(0);
    if (turn == 0) return InFacet::kUnsure;
    if (turn == q_side) inside = !inside;
  }
  return inside ? InFacet::kInside : InFacet::kOutside;
}

}  // namespace nef::planner
