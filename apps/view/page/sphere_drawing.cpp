// SPDX-License-Identifier: Apache-2.0
#include "apps/view/page/sphere_drawing.h"

#include <algorithm>
#include <cmath>

namespace nef::view {
namespace {

// Unit vector along exact integers of any size: scaled by a common power of two first.
std::array<double, 3> unit_vector(const Integer3& v) {
  std::size_t bits = 0;
  for (const Integer& x : v) bits = std::max(bits, x == 0 ? 0 : mpz_sizeinbase(x.get_mpz_t(), 2));
  std::array<double, 3> d{};
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, v[i].get_mpz_t());
    const long shift = exponent - static_cast<long>(bits);
    d[i] = shift < -2000 ? 0.0 : std::ldexp(mantissa, static_cast<int>(shift));
    square += d[i] * d[i];
  }
  for (double& x : d) x /= std::sqrt(square);
  return d;
}

std::array<double, 3> normal(const PlaneTable& planes, PlaneId plane) {
  return unit_vector({planes.oriented_coefficient(plane, 0), planes.oriented_coefficient(plane, 1),
                      planes.oriented_coefficient(plane, 2)});
}

}  // namespace

SphereDrawing draw_sphere_map(const Complex& complex, VertexId vertex) {
  const SphereMapView map = complex.sphere_map(vertex);
  const VertexRecord& at = complex.vertices[vertex];
  SphereDrawing drawing;
  drawing.mark = map.mark;
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    const SVertex& s = map.svertices[i];
    drawing.dots.push_back({unit_vector(Direction::cross(complex.planes, s.p, s.q).integers()), s.mark,
                            complex.halfedges(vertex)[i].index()});
  }
  for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) {
    const SHalfedge& e = map.shalfedges[i];
    drawing.arcs.push_back({e.source, map.target(i), normal(complex.planes, e.plane), e.mark,
                            facet_of(complex.shalfedge_facet[at.shalfedges + i]).index(), e.sface,
                            map.shalfedges[i + 1].sface});
  }
  for (std::uint32_t i = 0; i < map.sloops.size(); i += 2) {
    const SLoop& loop = map.sloops[i];
    drawing.circles.push_back({normal(complex.planes, loop.plane), loop.mark,
                               facet_of(complex.sloop_facet[at.sloops + i]).index(), loop.sface,
                               map.sloops[i + 1].sface});
  }
  for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) {
    drawing.regions.push_back({map.sfaces[i].mark, complex.sface_volume(at.sfaces + i).index()});
  }
  return drawing;
}

}  // namespace nef::view
