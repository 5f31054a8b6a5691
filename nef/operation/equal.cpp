// SPDX-License-Identifier: Apache-2.0
//
// Two sets are equal if and only if they have the same vertices in canonical order.
#include <algorithm>

#include "nef/operation/canonical_order.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

bool same_planes(const PlaneTable& a, const PlaneTable& b) {
  if (a.size() != b.size()) return false;
  for (std::uint32_t row = 0; row < a.size(); ++row) {
    const PlaneId plane = PlaneId::of_row(row);
    for (std::size_t column = 0; column < 5; ++column) {
      if (mpz_cmp(a.coefficient(plane, column), b.coefficient(plane, column)) != 0) return false;
    }
  }
  return true;
}

bool same_points(const PointTable& a, const PointTable& b) {
  if (a.size() != b.size()) return false;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!a.identical(PointId{i}, b, PointId{i})) return false;
  }
  return true;
}

// The planes of maps are rows of tables that are the same.
bool same_maps(const SphereMapView& a, const SphereMapView& b) {
  const auto same = [](const auto& x, const auto& y) { return std::equal(x.begin(), x.end(), y.begin(), y.end()); };
  return a.mark == b.mark && same(a.svertices, b.svertices) && same(a.shalfedges, b.shalfedges) &&
         same(a.sloops, b.sloops) && same(a.sfaces, b.sfaces) && same(a.entries, b.entries);
}

bool same_vertices(const Complex& a, const Complex& b) {
  const IdRange<VertexId> vertices = a.vertex_ids();
  return a.vertex_count() == b.vertex_count() && same_planes(a.planes, b.planes) && same_points(a.points, b.points) &&
         std::all_of(vertices.begin(), vertices.end(),
                     [&](VertexId v) { return same_maps(a.sphere_map(v), b.sphere_map(v)); });
}

}  // namespace

bool equal(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  const Complex& ca = a.complex();
  const Complex& cb = b.complex();
  if (&ca == &cb) return true;
  // Numbers of items differ as a rule if the sets do. An infimaximal box that nothing reaches is no part of a set.
  if (ca.has_box() == cb.has_box() && (ca.vertex_count() != cb.vertex_count() || ca.edge_count() != cb.edge_count() ||
                                       ca.facet_count() != cb.facet_count())) {
    return false;
  }
  const CanonicalVertices of_a = canonical_vertices(a, monitor);
  const CanonicalVertices of_b = canonical_vertices(b, monitor);
  return of_a.outer == of_b.outer && same_vertices(of_a.unlinked, of_b.unlinked);
}

}  // namespace nef
