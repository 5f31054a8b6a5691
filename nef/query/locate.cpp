// SPDX-License-Identifier: Apache-2.0
//
// The queries of nef/polyhedron.h: point location, local pyramids and rays.
#include "nef/base/error.h"
#include "nef/complex/local_pyramid.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/location/query_structure.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

Location location_of(const Complex& complex, const ItemRef& item) { return {item, mark_of(complex, item)}; }

}  // namespace

Location locate(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  const Complex& complex = a.complex();
  if (complex.vertex_count() == 0) return location_of(complex, ItemRef(kOuterVolume));
  PointTable table;
  const PointRef query{&table, table.push(point)};
  const QueryStructure& structure = a.queries();
  const ItemRef item = structure.item_at(complex, query, monitor);
  return location_of(complex, item.valid() ? item : ItemRef(structure.volume_at(complex, query, monitor)));
}

bool contains(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  return locate(a, point, monitor).mark != 0;
}

SphereMapBuffer local_pyramid(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  SphereMapBuffer result;
  pyramid_of(a.complex(), locate(a, point, monitor), result);
  return result;
}

std::optional<RayHit> shoot_ray(const Polyhedron& a, const Rational3& origin, const Rational3& direction,
                                const std::function<bool(const Location&)>& accept, const Monitor& monitor) {
  if (is_zero(direction)) throw InputError("a ray needs a direction other than 0,0,0");
  const Complex& complex = a.complex();
  if (complex.vertex_count() == 0) return std::nullopt;
  const Integer3 d = primitive(direction);
  PointTable table;
  const Direction towards = Direction::exact(d[0], d[1], d[2]);
  const QueryRay ray{{&table, table.push(origin)}, towards};
  // The box of an unbounded set is at infinity, where no point is: it is not met.
  const auto takes = [&](const ComplexHit& hit) {
    const bool at_infinity = hit.kind == ComplexHit::Kind::kVertex ? !complex.points.finite(point_of(hit.vertex()))
                             : hit.kind == ComplexHit::Kind::kEdge
                                 ? complex.planes.infimaximal(complex.svertex(hit.halfedge()).p) ||
                                       complex.planes.infimaximal(complex.svertex(hit.halfedge()).q)
                                 : complex.planes.infimaximal(complex.facets[hit.facet()].plane);
    return !at_infinity && (!accept || accept(location_of(complex, hit)));
  };
  RayHit result;
  const std::optional<ComplexHit> hit = a.queries().first_hit(complex, ray, takes, &result.point, monitor);
  if (!hit) return std::nullopt;
  result.location = location_of(complex, *hit);
  return result;
}

}  // namespace nef
