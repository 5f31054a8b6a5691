// SPDX-License-Identifier: Apache-2.0
//
// The invariants of facets: each shalfedge is a corner of one cycle, cycles are closed walks along
// edges, lie in one plane, are oriented and nested as outer cycles and holes must be.
#include <vector>

#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/validation/concrete_points.h"
#include "nef/validation/validate.h"

namespace nef::detail {
namespace {

void check_facet_ranges(const Complex& c) {
  require(!c.cycle_begin.empty() && c.cycle_begin.front() == 0 && c.cycle_begin.back() == c.corners.size(),
          "cycles cover the corners", {});
  std::size_t cycles = 0;
  std::size_t isolated = 0;
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    require(facet.plane.valid() && facet.plane.row() < c.planes.size() && !facet.plane.flipped(),
            "a facet has an unflipped plane", {{"facet", f}});
    require(facet.first_cycle == CycleId{cycles} && facet.cycle_count > 0, "facets have cycles, one after the other",
            {{"facet", f}});
    cycles += facet.cycle_count;
    if (facet.isolated_count > 0) {
      require(facet.first_isolated == isolated, "isolated vertices of facets follow each other", {{"facet", f}});
    }
    isolated += facet.isolated_count;
    require(c.volumes.contains(facet.volume_above) && c.volumes.contains(facet.volume_below),
            "volumes of a facet exist", {{"facet", f}});
  }
  require(cycles + 1 == c.cycle_begin.size(), "every cycle belongs to a facet", {{"cycles", cycles}});
  require(isolated == c.isolated_vertices.size(), "every isolated vertex belongs to a facet", {});
  for (const CycleId i : c.cycle_ids()) {
    require(c.cycle_begin[i] < c.cycle_begin[i.next()], "cycles are not empty", {{"cycle", i}});
  }
}

void check_corner(const Complex& c, FacetId f, SHalfedgeId corner) {
  const Facet& facet = c.facets[f];
  require(corner.index() < c.shalfedge_count(), "corners are shalfedges", {{"facet", f}, {"corner", corner}});
  const SHalfedge& e = c.shalfedge(corner);
  require(e.plane == facet.plane, "corners lie in the plane of their facet", {{"facet", f}, {"shalfedge", corner}});
  require(e.mark == facet.mark, "corners have the mark of their facet", {{"facet", f}, {"shalfedge", corner}});
  require(c.shalfedge_facet[corner] == halffacet_of(f, false) &&
              c.shalfedge_facet[twin_of(corner)] == halffacet_of(f, true),
          "shalfedges know their halffacet", {{"facet", f}, {"shalfedge", corner}});
  require(c.sface_volume(c.shalfedge_sface(corner)) == facet.volume_above &&
              c.sface_volume(c.shalfedge_sface(twin_of(corner))) == facet.volume_below,
          "a facet has one volume on each side", {{"facet", f}, {"shalfedge", corner}});
}

void check_cycles(const Complex& c) {
  IndexedVector<SHalfedgeId, bool> met(c.shalfedge_count(), false);
  for (const FacetId f : c.facets.ids()) {
    for (const CycleId k : c.facets[f].cycles()) {
      const std::span<const SHalfedgeId> cycle = c.corners_of(k);
      for (std::size_t i = 0; i < cycle.size(); ++i) {
        const SHalfedgeId corner = cycle[i];
        check_corner(c, f, corner);
        require(!met[corner], "a corner belongs to one cycle", {{"facet", f}, {"shalfedge", corner}});
        met[corner] = met[twin_of(corner)] = true;
        const SHalfedgeId following = cycle[(i + 1) % cycle.size()];
        require(following.index() < c.shalfedge_count() &&
                    c.twin[c.corner_halfedge(corner)] == c.corner_back_halfedge(following),
                "cycles follow edges", {{"facet", f}, {"shalfedge", corner}, {"shalfedge", following}});
      }
    }
  }
  for (const SHalfedgeId e : c.shalfedge_ids()) require(met[e], "every shalfedge is a corner", {{"shalfedge", e}});
}

void check_isolated_vertices(const Complex& c) {
  IndexedVector<VertexId, bool> met(c.vertex_count(), false);
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    for (const VertexId v : c.isolated_vertices_of(facet)) {
      require(met.contains(v) && !met[v], "an isolated vertex lies in one facet", {{"facet", f}, {"vertex", v}});
      met[v] = true;
      const SphereMapView map = c.sphere_map(v);
      require(map.sloops.size() == 2, "a vertex inside a facet has a sloop", {{"facet", f}, {"vertex", v}});
      for (std::uint32_t side = 0; side < 2; ++side) {
        const SLoop& loop = map.sloops[side];
        const HalffacetId halffacet = halffacet_of(f, loop.plane.flipped());
        require(loop.plane.row() == facet.plane.row() && loop.mark == facet.mark,
                "a sloop has plane and mark of its facet", {{"facet", f}, {"vertex", v}});
        require(c.sloop_facet[c.vertices[v].sloops + side] == halffacet, "sloops know their halffacet",
                {{"facet", f}, {"vertex", v}});
        require(c.sface_volume(c.vertices[v].sfaces + loop.sface) == c.halffacet_volume(halffacet),
                "a facet has one volume on each side", {{"facet", f}, {"vertex", v}});
      }
    }
  }
  for (const VertexId v : c.vertex_ids()) {
    require(met[v] || c.vertices[v].sloops == c.vertices[v.next()].sloops, "a vertex with a sloop lies in a facet",
            {{"vertex", v}});
  }
}

// Twice the area of the projected polygon.
Rational doubled_area(const std::vector<const Rational3*>& polygon, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  Rational area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Rational3& a = *polygon[i];
    const Rational3& b = *polygon[(i + 1) % polygon.size()];
    area += a[x] * b[y] - a[y] * b[x];
  }
  return area;
}

void check_cycle_nesting(const Complex& c) {
  const IndexedVector<VertexId, Rational3> points = concrete_points(c);
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    const ProjectionAxis projection = projection_axis(c.planes, facet.plane);
    std::vector<std::vector<const Rational3*>> cycles;
    std::vector<Box> boxes(facet.cycle_count);
    for (std::uint32_t k = 0; k < facet.cycle_count; ++k) {
      const CycleId cycle = facet.cycles()[k];
      cycles.push_back(cycle_points(c, points, cycle));
      for (const SHalfedgeId corner : c.corners_of(cycle)) {
        boxes[k].add_rounded(c.points.approximate(point_of(c.shalfedge_vertex(corner))));
      }
      const int area = projection.sign * sgn(doubled_area(cycles[k], projection.axis));
      require(k == 0 ? area > 0 : area <= 0, k == 0 ? "the outer cycle comes first" : "holes run clockwise",
              {{"facet", f}, {"cycle", cycle}});
    }
    // A point of the facet: inside the outer cycle, outside of all holes but its own.
    const auto check_inside = [&](VertexId vertex, std::size_t own, const GuiltyItem& item) {
      Box box;
      box.add_rounded(c.points.approximate(point_of(vertex)));
      for (std::size_t k = 0; k < cycles.size(); ++k) {
        if (k == own || (k > 0 && !boxes[k].overlaps(box))) continue;
        const Winding winding = winding_number(cycles[k], points[vertex], projection.axis);
        require(!winding.on_boundary && winding.number == (k == 0 ? projection.sign : 0),
                "holes lie inside the outer cycle of their facet and outside of other holes", {{"facet", f}, item});
      }
    };
    for (std::uint32_t k = 1; k < facet.cycle_count; ++k) {
      const CycleId cycle = facet.cycles()[k];
      check_inside(c.shalfedge_vertex(c.corners_of(cycle)[0]), k, {"cycle", cycle});
    }
    for (const VertexId v : c.isolated_vertices_of(facet)) {
      check_inside(v, cycles.size(), {"vertex", v});
    }
  }
}

}  // namespace

void check_facets(const Complex& complex) {
  for (const SFaceId s : complex.sface_ids()) {
    require(complex.shells.contains(complex.sface_shell[s]), "sfaces have a shell", {{"sface", s}});
  }
  for (const ShellId s : complex.shells.ids()) {
    require(complex.volumes.contains(complex.shells[s].volume), "shells have a volume", {{"shell", s}});
  }
  check_facet_ranges(complex);
  check_cycles(complex);
  check_isolated_vertices(complex);
  check_cycle_nesting(complex);
}

}  // namespace nef::detail
