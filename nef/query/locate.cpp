// SPDX-License-Identifier: Apache-2.0
//
// The queries of nef/polyhedron.h: point location, local pyramids and rays.
#include "nef/base/error.h"
#include "nef/complex/local_pyramid.h"
#include "nef/geometry/integer_vector.h"
#include "nef/location/query_structure.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

Location location_of(const Complex& complex, const ComplexHit& hit) {
  switch (hit.kind) {
    case ComplexHit::Kind::kVertex:
      return {Location::Kind::kVertex, hit.index, complex.mark(hit.vertex())};
    case ComplexHit::Kind::kEdge:
      return {Location::Kind::kEdge, hit.index, complex.svertex(hit.halfedge()).mark};
    case ComplexHit::Kind::kFacet:
      break;
  }
  const FacetId facet = facet_of(hit.halffacet());
  return {Location::Kind::kFacet, facet.index(), complex.facets[facet].mark};
}

}  // namespace

Location locate(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  const Complex& complex = a.complex();
  if (complex.vertex_count() == 0) return {Location::Kind::kVolume, 0, complex.volumes[kOuterVolume].mark};
  PointTable table;
  const PointRef query{&table, table.push(point)};
  const QueryStructure& structure = a.queries();
  if (const std::optional<ComplexHit> hit = structure.item_at(complex, query, monitor))
    return location_of(complex, *hit);
  const VolumeId volume = structure.volume_at(complex, query, monitor);
  return {Location::Kind::kVolume, volume.index(), complex.volumes[volume].mark};
}

bool contains(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  return locate(a, point, monitor).mark != 0;
}

SphereMapBuffer local_pyramid(const Polyhedron& a, const Rational3& point, const Monitor& monitor) {
  const Complex& complex = a.complex();
  const Location where = locate(a, point, monitor);
  SphereMapBuffer result;
  switch (where.kind) {
    case Location::Kind::kVertex: {
      result.assign(complex.sphere_map(where.vertex()));
      break;
    }
    case Location::Kind::kEdge: {
      const VertexId vertex = complex.source(where.halfedge());
      edge_pyramid(complex.sphere_map(vertex), complex.halfedges(vertex).position(where.halfedge()), result);
      break;
    }
    case Location::Kind::kFacet: {
      const Facet& facet = complex.facets[where.facet()];
      result.assign_circle(facet.plane, facet.mark, complex.volumes[facet.volume_above].mark,
                           complex.volumes[facet.volume_below].mark);
      break;
    }
    case Location::Kind::kVolume:
      result.assign_trivial(where.mark);
  }
  return result;
}

std::optional<RayHit> shoot_ray(const Polyhedron& a, const Rational3& origin, const Rational3& direction,
                                const std::function<bool(const Location&)>& accept, const Monitor& monitor) {
  if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0) {
    throw InputError("a ray needs a direction other than 0,0,0");
  }
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
                                 : complex.planes.infimaximal(complex.facets[facet_of(hit.halffacet())].plane);
    return !at_infinity && (!accept || accept(location_of(complex, hit)));
  };
  RayHit result;
  const std::optional<ComplexHit> hit = a.queries().first_hit(complex, ray, takes, &result.point, monitor);
  if (!hit) return std::nullopt;
  result.location = location_of(complex, *hit);
  return result;
}

}  // namespace nef
