// SPDX-License-Identifier: Apache-2.0
#include "nef/distance/crossing_filter.h"

#include "nef/geometry/ray_parity.h"

namespace nef {

CrossingFilter::CrossingFilter(const Complex& complex, std::span<const Rational3> points) {
  for (const Rational3& p : points)
    points_.push_back({approximation_of(p[0]), approximation_of(p[1]), approximation_of(p[2])});
  constexpr std::size_t kMany = 64;
  begin_.push_back(0);
  for (const Facet& facet : complex.facets) {
    Plane& plane = planes_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      plane.normal[i] = approximation_of(Rational(Integer(complex.planes.coefficient(facet.plane, i))));
      if (std::fabs(plane.normal[i].value) > std::fabs(plane.normal[plane.axis].value)) plane.axis = i;
    }
    plane.offset = approximation_of(Rational(Integer(complex.planes.coefficient(facet.plane, 3))));
    if (complex.corners_of(facet).size() < kMany && complex.isolated_vertices_of(facet).empty()) {
      for (const SHalfedgeId corner : complex.corners_of(facet)) {
        sides_.push_back(
            {complex.shalfedge_vertex(corner).index(), complex.target(complex.corner_halfedge(corner)).index()});
      }
    }
    begin_.push_back(static_cast<std::uint32_t>(sides_.size()));
  }
}

Approximation CrossingFilter::value(const Approximation3& normal, const Approximation& offset,
                                    const Approximation3& at) const {
  return dot(normal, at) + offset;
}

std::optional<bool> CrossingFilter::holds(FacetId facet, const Approximation3& at, std::size_t u, std::size_t v) const {
  RayParity parity(at, u, v);
  for (std::uint32_t s = begin_[facet.index()]; s < begin_[facet.index() + 1]; ++s) {
    if (!parity.add(points_[sides_[s][0]], points_[sides_[s][1]])) return std::nullopt;
  }
  return parity.is_inside();
}

EdgeCrossing CrossingFilter::ask(FacetId facet, const Approximation3& from, const Approximation3& to) const {
  const Plane& plane = planes_[facet.index()];
  const Approximation of_from = value(plane.normal, plane.offset, from);
  const Approximation of_to = value(plane.normal, plane.offset, to);
  const int side = of_from.sign().value_or(0);
  const int other = of_to.sign().value_or(0);
  if (side == 0 || other == 0) return EdgeCrossing::kUnsure;
  if (side == other) return EdgeCrossing::kApart;
  if (begin_[facet.index()] == begin_[facet.index() + 1]) return EdgeCrossing::kUnsure;
  const Approximation part = of_from / (of_from - of_to);
  Approximation3 at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = from[i] + part * (to[i] - from[i]);
  // Sides along an axis are common, so if a ray along one axis passes near a corner, the other one may not.
  const std::size_t u = (plane.axis + 1) % 3;
  const std::size_t v = (plane.axis + 2) % 3;
  std::optional<bool> inside = holds(facet, at, u, v);
  if (!inside) inside = holds(facet, at, v, u);
  if (!inside) return EdgeCrossing::kUnsure;
  return *inside ? EdgeCrossing::kCrosses : EdgeCrossing::kApart;
}

}  // namespace nef
