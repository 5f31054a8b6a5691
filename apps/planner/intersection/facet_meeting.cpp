// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/intersection/facet_meeting.h"

#include <cmath>

#include "nef/complex/facet_plane.h"
#include "nef/geometry/ray_parity.h"

namespace nef::planner {
namespace {

// A coordinate of a vertex or of a given point, which is within 4u of the truth, or within 2^-1074 where it is tiny.
Approximation coordinate(double value) { return {value, 4 * kRoundingUnit * std::fabs(value) + 1e-300}; }

}  // namespace

// With forms f and g at the ends t = f / (f - g).
Approximation3 crossing_point(const Vector3d& from, const Vector3d& to, const Approximation& form_at_from,
                              const Approximation& form_at_to) {
  const Approximation t = form_at_from / (form_at_from - form_at_to);
  Approximation3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    result[k] = coordinate(from[i]) + t * (coordinate(to[i]) - coordinate(from[i]));
  }
  return result;
}

InFacet in_facet(const Complex& complex, const Facet& facet, const Approximation3& point) {
  const PlaneAxes axes(complex.planes, facet.plane);
  RayParity parity(point, static_cast<std::size_t>(axes.first), static_cast<std::size_t>(axes.second));
  const auto at = [&complex](VertexId v) {
    const std::array<double, 3>& x = complex.points.approximate(point_of(v));
    return Approximation3{coordinate(x[0]), coordinate(x[1]), coordinate(x[2])};
  };
  for (const SHalfedgeId corner : complex.corners_of(facet)) {
    const HalfedgeId halfedge = complex.corner_halfedge(corner);
    if (!parity.add(at(complex.source(halfedge)), at(complex.target(halfedge)))) return InFacet::kUnsure;
  }
  return parity.is_inside() ? InFacet::kInside : InFacet::kOutside;
}

}  // namespace nef::planner
