// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/halfspace_sum.h"

#include <algorithm>
#include <vector>

#include "nef/construct/construct.h"

namespace nef::minkowski {
namespace {

Rational oriented(const PlaneTable& planes, PlaneId plane, std::size_t column) {
  return Rational(planes.oriented_coefficient(plane, column));
}

// Whether b has a point on the plane n.x = top, which supports its closure.
bool reaches(const Polyhedron& b, const Rational3& n, const Rational& top) {
  const Complex& c = b.complex();
  const auto on_plane = [&](std::uint32_t v) {
    const Rational3 p = c.points.rational(PointId(v));
    return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] == top;
  };
  std::vector<std::uint8_t> on(c.vertex_count());
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) on[v] = on_plane(v) ? 1 : 0;
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) {
    if (on[v] != 0 && c.vertices[v].mark == 1) return true;
  }
  for (std::uint32_t h = 0; h < c.svertices.size(); ++h) {
    if (c.svertices[h].mark == 1 && on[c.svertex_owner[h]] != 0 && on[c.target(h)] != 0) return true;
  }
  return std::any_of(c.facets.begin(), c.facets.end(), [&](const Facet& f) {
    const auto corners = c.facet_corners(f);
    return f.mark == 1 &&
           std::all_of(corners.begin(), corners.end(), [&](std::uint32_t k) { return on[c.shalfedge_owner[k]] != 0; });
  });
}

}  // namespace

std::optional<Polyhedron> halfspace_sum(const Polyhedron& h, const Polyhedron& b) {
  const Complex& c = h.complex();
  const bool closed = h.is_closed();
  if (!closed && !h.is_open()) return std::nullopt;
  // The one plane in question is that of a facet which is not on the infimaximal box.
  for (const Facet& f : c.facets) {
    if (c.planes.infimaximal(f.plane) || f.mark == kOutside) continue;
    // Seen from the outside of the half-space n.x + d <= 0, n points at us.
    const bool above = c.volumes[f.volume_above].mark == 1;
    const PlaneId plane = above ? f.plane.opposite() : f.plane;
    const Rational3 n = {oriented(c.planes, plane, 0), oriented(c.planes, plane, 1), oriented(c.planes, plane, 2)};
    const Rational d = oriented(c.planes, plane, 3);
    if (!equal(h, make_halfspace(n[0], n[1], n[2], d, closed))) return std::nullopt;
    std::optional<Rational> top;
    const Complex& bounded = b.complex();
    for (std::uint32_t v = 0; v < bounded.vertex_count(); ++v) {
      const Rational3 p = bounded.points.rational(PointId(v));
      const Rational value = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
      if (!top || value > *top) top = value;
    }
    return make_halfspace(n[0], n[1], n[2], Rational(d - *top), closed && reaches(b, n, *top));
  }
  return std::nullopt;
}

}  // namespace nef::minkowski
