// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/predicates_of_sets.h"

namespace nef {
namespace {

// True if test(mark, sfaces around) holds for every boundary item in space. The second argument
// tells whether some volume at the item is in the set.
template <typename Test>
bool all_boundary_items(const Complex& c, const Test& test) {
  const auto volume_selected = [&c](VolumeId volume) { return is_selected(c.volumes[volume].mark); };
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    if (is_box_facet(c, f)) continue;
    if (!test(facet.mark, volume_selected(facet.volume_above) || volume_selected(facet.volume_below))) return false;
  }
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    bool near_vertex = false;
    for (const SFace& sface : map.sfaces) near_vertex = near_vertex || is_selected(sface.mark);
    if (!is_box_vertex(c, v) && !test(c.mark(v), near_vertex)) return false;
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      const HalfedgeId halfedge = c.halfedges(v)[s];
      if (halfedge > c.twin[halfedge] || is_box_edge(c, halfedge)) continue;
      const SVertex& edge = map.svertices[s];
      bool near_edge = edge.out == kNone && is_selected(map.sfaces[edge.sface].mark);
      if (edge.out != kNone) {
        std::uint32_t e = edge.out;
        do {
          near_edge = near_edge || is_selected(map.sfaces[map.shalfedges[e].sface].mark);
          e = map.next_around(e);
        } while (e != edge.out);
      }
      if (!test(edge.mark, near_edge)) return false;
    }
  }
  return true;
}

}  // namespace

bool is_box_vertex(const Complex& complex, VertexId vertex) { return !complex.points.finite(point_of(vertex)); }

bool is_box_edge(const Complex& complex, HalfedgeId halfedge) {
  // At most one finite plane goes through an edge of the box, so one of any two is the box's.
  const SVertex& edge = complex.svertex(halfedge);
  return complex.planes.infimaximal(edge.p) || complex.planes.infimaximal(edge.q);
}

bool is_box_facet(const Complex& complex, FacetId facet) {
  return complex.planes.infimaximal(complex.facets[facet].plane);
}

bool has_finite_corners(const Complex& complex, const Facet& facet) {
  for (const SHalfedgeId corner : complex.corners_of(facet)) {
    if (is_box_vertex(complex, complex.shalfedge_vertex(corner))) return false;
  }
  return true;
}

bool is_open_set(const Complex& complex) {
  return all_boundary_items(complex, [](LabelId mark, bool) { return !is_selected(mark); });
}

bool is_closed_set(const Complex& complex) {
  return all_boundary_items(complex, [](LabelId mark, bool) { return is_selected(mark); });
}

bool is_full_dimensional_set(const Complex& complex) {
  return all_boundary_items(complex, [](LabelId mark, bool full) { return !is_selected(mark) || full; });
}

bool is_regular_set(const Complex& complex) {
  return all_boundary_items(complex, [](LabelId mark, bool full) { return is_selected(mark) && full; });
}

bool is_bounded_set(const Complex& complex) {
  if (is_selected(complex.volumes[kOuterVolume].mark)) return false;
  if (!complex.has_box()) return true;
  // A part of the set goes to infinity iff it reaches the box: on a facet that ends there, along
  // an edge, or through a volume.
  for (const VertexId v : complex.vertex_ids()) {
    if (!is_box_vertex(complex, v)) continue;
    const SphereMapView map = complex.sphere_map(v);
    for (const SFace& sface : map.sfaces) {
      if (is_selected(sface.mark)) return false;
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
      if (is_selected(map.shalfedges[e].mark) && !complex.planes.infimaximal(map.shalfedges[e].plane)) return false;
    }
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      const HalfedgeId halfedge = complex.halfedges(v)[s];
      if (is_selected(map.svertices[s].mark) && !is_box_edge(complex, halfedge)) return false;
    }
  }
  return true;
}

}  // namespace nef
