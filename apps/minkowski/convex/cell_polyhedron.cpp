// SPDX-License-Identifier: Apache-2.0
//
// From a marked convex cell to a Nef polyhedron: the closed set is built first, then the marks of
// its boundary are set in a copy of its complex. That keeps the complex valid: no item of the
// boundary of a convex set becomes superfluous, whatever its own mark, since the inside is selected and
// the outside is not.
#include <map>
#include <utility>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/error.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/construct/solid.h"
#include "nef/geometry/plane_finder.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// With normals at hand, planes need no more than an offset, and there is nothing to check.
Polyhedron solid_with_normals(const ConvexCell& cell, const SolidMarks& marks, const Monitor& monitor) {
  SolidFaces faces;
  faces.points.reserve(cell.mesh.vertices.size());
  for (const Rational3& p : cell.mesh.vertices) faces.points.push(p);
  faces.planes.reserve(cell.mesh.face_count());
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    faces.plane.push_back(plane_through(faces.planes, faces.points, cell.normals[f], PointId(cell.mesh.face(f)[0])));
  }
  faces.begin = cell.mesh.face_begin;
  faces.corners = cell.mesh.corners;
  return Polyhedron(make_solid(std::move(faces), marks, monitor));
}

Polyhedron closed_polyhedron(const ConvexCell& cell, const Monitor& monitor) {
  const std::vector<Rational3>& v = cell.mesh.vertices;
  switch (cell.dimension) {
    case 0:
      return make_point(v[0], monitor);
    case 1:
      return make_segment(v[0], v[1], monitor);
    case 2: {
      std::vector<Rational3> ring;
      for (const std::uint32_t i : cell.mesh.face(0)) ring.push_back(v[i]);
      return make_polygon(std::span<const std::vector<Rational3>>(&ring, 1), monitor);
    }
    default:
      if (!cell.normals.empty()) return solid_with_normals(cell, {.boundary = 1, .inside = 1, .outside = 0}, monitor);
      return from_mesh(cell.mesh, MeshOptions{.strict = true, .as_surface = false, .check = false, .monitor = monitor});
  }
}

// Which item of the cell an item of its complex is.
class Correspondence {
 public:
  Correspondence(const ConvexCell& cell, const Complex& complex) : cell_(cell) {
    std::map<Rational3, std::uint32_t> index;
    for (std::uint32_t v = 0; v < cell.mesh.vertices.size(); ++v) index.emplace(cell.mesh.vertices[v], v);
    for (const VertexId v : complex.vertex_ids()) {
      vertex_.push_back(index.at(complex.points.rational(point_of(v))));
    }
    for (std::uint32_t f = 0; f < cell.mesh.face_count(); ++f) {
      const std::uint32_t first = cell.mesh.face_begin[f];
      const std::uint32_t last = cell.mesh.face_begin[f + 1];
      for (std::uint32_t c = first; c < last; ++c) {
        corner_[{cell.mesh.corners[c], cell.mesh.corners[c + 1 < last ? c + 1 : first]}] = {c, f};
      }
    }
  }

  [[nodiscard]] bool vertex(VertexId v) const { return cell_.vertex_marked(vertex_[v]); }

  [[nodiscard]] bool edge(VertexId from, VertexId to) const {
    if (cell_.dimension == 1) return true;
    const auto it = corner_.find({vertex_[from], vertex_[to]});
    // The one face of a polygon has each edge in one direction only.
    return cell_.edge_marked((it != corner_.end() ? it : corner_.find({vertex_[to], vertex_[from]}))->second.first);
  }

  // The facet whose boundary passes three vertices in one order or the other.
  [[nodiscard]] bool facet(VertexId u, VertexId v, VertexId w) const {
    if (cell_.dimension == 2) return true;
    const std::uint32_t forth = corner_.at({vertex_[u], vertex_[v]}).second;
    const auto next = corner_.find({vertex_[v], vertex_[w]});
    const bool is_forth = next != corner_.end() && next->second.second == forth;
    return cell_.facet_marked(is_forth ? forth : corner_.at({vertex_[v], vertex_[u]}).second);
  }

 private:
  const ConvexCell& cell_;
  IndexedVector<VertexId, std::uint32_t> vertex_;  // of the complex -> of the cell
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>>
      corner_;  // -> corner, face
};

}  // namespace

Polyhedron to_polyhedron(const ConvexCell& cell, const Monitor& monitor) {
  if (cell.boundary == ConvexCell::Boundary::kOpen && cell.dimension == 3 && !cell.normals.empty()) {
    return solid_with_normals(cell, {.boundary = 0, .inside = 1, .outside = 0}, monitor);
  }
  Polyhedron closed = closed_polyhedron(cell, monitor);
  if (cell.boundary == ConvexCell::Boundary::kClosed) return closed;
  if (cell.boundary == ConvexCell::Boundary::kOpen && cell.dimension == 3) return interior(closed, monitor);

  Complex complex = closed.complex();
  const Correspondence of(cell, complex);
  complex.facets.assign_marks([&](FacetId facet) -> LabelId {
    const auto corners = complex.corners_of(facet);
    const auto owner = [&](std::size_t k) { return complex.shalfedge_vertex(corners[k]); };
    return of.facet(owner(0), owner(1), owner(2)) ? 1 : 0;
  });
  rewrite_sphere_maps(complex, [&](VertexId v, SphereMapBuffer& map) {
    const VertexRecord& record = complex.vertices[v];
    map.mark = of.vertex(v) ? 1 : 0;
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      map.svertices[s].mark = of.edge(v, complex.target(record.svertices + s)) ? 1 : 0;
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      map.shalfedges[e].mark = complex.facets[facet_of(complex.shalfedge_facet[record.shalfedges + e])].mark;
    }
  });
  return Polyhedron(std::move(complex));
}

}  // namespace nef::minkowski
