// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/planar/flat_sets.h"

#include <algorithm>
#include <vector>

#include "apps/minkowski/planar/planar_sum.h"
#include "nef/construct/construct.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
namespace {

// True if nothing but facets, their edges and corners belongs to a set, and all of these do.
bool is_closed_surface(const Complex& c) {
  for (const Facet& f : c.facets) {
    if (f.mark == 0 || c.volumes[f.volume_above].mark != 0 || c.volumes[f.volume_below].mark != 0) return false;
  }
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    if (map.mark == 0 || map.shalfedges.empty() || !map.sloops.empty()) return false;
    for (const SVertex& s : map.svertices) {
      if (s.mark == 0 || s.out == kNone) return false;
    }
  }
  return c.facet_count() > 0;
}

// The facets of both, if all planes are parallel.
bool are_parallel(const Complex& a, const Complex& b, const Monitor& monitor) {
  const Direction first = Direction::normal(a.planes, a.facets[FacetId{0U}].plane);
  const Direction back = first.negated();
  for (const Complex* c : {&a, &b}) {
    for (const Facet& f : c->facets) {
      const Direction normal = Direction::normal(c->planes, f.plane);
      if (!same_direction(normal, first, monitor) && !same_direction(normal, back, monitor)) return false;
    }
  }
  return true;
}

// Rings with the facet on their left as it is seen in a frame.
PlanarPolygon polygon_of(const Complex& c, const Facet& facet, const PlanarFrame& frame) {
  const bool mirrored = projection_axis(c.planes, facet.plane).sign != frame.sign;
  PlanarPolygon result;
  for (const CycleId cycle : facet.cycles()) {
    const auto first = static_cast<std::ptrdiff_t>(result.corners.size());
    for (const SHalfedgeId corner : c.corners_of(cycle))
      result.corners.push_back(c.points.rational(point_of(c.shalfedge_vertex(corner))));
    if (mirrored) std::reverse(result.corners.begin() + first, result.corners.end());
    result.ring_end.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

Polyhedron set_of(const PlanarSum& sum, const PlanarFrame& frame, const Monitor& monitor) {
  const MeshPoints points(sum.points);
  std::vector<Triangulator::Triangle> triangles;
  const bool done = Triangulator(points, monitor).triangulate(sum.rings, frame.axis, frame.sign, triangles);
  NEF_ASSERT(done);
  Mesh mesh;
  mesh.vertices = sum.points;
  for (const Triangulator::Triangle& t : triangles) mesh.push_face(t);
  MeshOptions options;
  options.as_surface = true;
  options.check = false;
  options.monitor = monitor;
  return from_mesh(mesh, options);
}

}  // namespace

std::optional<Polyhedron> sum_of_flat_sets(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  for (const Polyhedron* set : {&a, &b}) {
    if (!set->is_bounded() || !is_closed_surface(set->complex())) return std::nullopt;
  }
  const Complex& c = a.complex();
  const Complex& d = b.complex();
  if (!are_parallel(c, d, monitor)) return std::nullopt;
  const PlanarFrame frame = projection_axis(c.planes, c.facets[FacetId{0U}].plane);
  std::vector<PlanarPolygon> others;
  for (const Facet& g : d.facets) others.push_back(polygon_of(d, g, frame));
  std::vector<Polyhedron> sums;
  for (const Facet& f : c.facets) {
    const PlanarPolygon polygon = polygon_of(c, f, frame);
    for (const PlanarPolygon& other : others)
      sums.push_back(set_of(planar_sum(polygon, other, frame, monitor), frame, monitor));
  }
  return unite_all(sums, monitor);
}

}  // namespace nef::minkowski
