// SPDX-License-Identifier: Apache-2.0
//
// The validator: arrays, owners, vertices, edges and marks here, sphere maps, facets and volumes in the files beside.
// The order matters: each check relies on those before it, and the first broken invariant ends the search. Geometry is
// compared exactly and, where that is possible, in another way than synthesis has used. O(n log n), plus O(k^2) for a
// sphere map of k items.
#include <algorithm>
#include <numeric>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

using detail::require;

// Everything that reads a sphere map relies on it.
void check_pattern(const Complex& c, const VertexRecord& a, const VertexRecord& b, VertexId v) {
  require(a.pattern.index() < c.patterns.size(), "vertices have a pattern", {{"vertex", v}});
  const SphereMapView map = c.patterns.view(a.pattern);
  const std::uint32_t pairs = (b.shalfedges - a.shalfedges) / 2;
  require(map.svertices.size() == b.svertices - a.svertices && map.shalfedges.size() == 2 * std::size_t{pairs} &&
              map.sfaces.size() == b.sfaces - a.sfaces && !is_odd(a.shalfedges),
          "vertices have as many items as their patterns", {{"vertex", v}});
  const std::uint32_t planes = pairs + b.other_planes - a.other_planes;
  for (const SVertex& s : map.svertices) {
    require(s.p.row() < planes && s.q.row() < planes, "patterns name planes of their vertices", {{"vertex", v}});
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    require(map.shalfedges[e].plane == PlaneId{e}, "patterns name planes of their vertices", {{"vertex", v}});
  }
}

void check_array_sizes(const Complex& c) {
  require(c.points.size() == c.vertex_count(), "one point for each vertex",
          {{"points", c.points.size()}, {"vertices", c.vertex_count()}});
  const VertexRecord& last = c.vertices.back();
  require(last.shalfedges.index() == c.shalfedge_plane.size() && last.sloops == c.sloops.size() &&
              last.other_planes == c.other_planes.size(),
          "the sentinel ends all sphere items", {});
  require(c.svertex_owner.size() == c.svertex_count() && c.twin.size() == c.svertex_count() &&
              (c.pair_owner.empty() || c.pair_owner.size() == c.shalfedge_count() / 2) &&
              c.shalfedge_facet.size() == c.shalfedge_count() && c.sloop_facet.size() == c.sloops.size() &&
              c.sface_shell.size() == c.sface_count(),
          "columns of synthesis are parallel to the sphere items", {});
  const VertexRecord& first = c.vertices.front();
  require(
      first.svertices.index() + first.shalfedges.index() + first.sloops + first.sfaces.index() + first.other_planes ==
          0,
      "the first vertex begins at zero", {});
  for (const VertexId v : c.vertex_ids()) {
    const VertexRecord& a = c.vertices[v];
    const VertexRecord& b = c.vertices[v.next()];
    require(a.svertices <= b.svertices && a.shalfedges <= b.shalfedges && a.sloops <= b.sloops &&
                a.sfaces <= b.sfaces && a.other_planes <= b.other_planes,
            "ranges of sphere items are in order", {{"vertex", v}});
    check_pattern(c, a, b, v);
  }
}

void check_owners(const Complex& c) {
  for (const VertexId v : c.vertex_ids()) {
    const VertexRecord& a = c.vertices[v];
    const VertexRecord& b = c.vertices[v.next()];
    const auto owned = [&](const std::vector<VertexId>& owner, std::uint32_t first, std::uint32_t last) {
      return std::all_of(owner.begin() + first, owner.begin() + last, [v](VertexId o) { return o == v; });
    };
    require(owned(c.svertex_owner.values(), a.svertices.index(), b.svertices.index()), "svertices know their vertex",
            {{"vertex", v}});
    require(c.pair_owner.empty() ? c.shalfedge_count() == 0 || a.svertices.index() == pair_of(a.shalfedges)
                                 : owned(c.pair_owner, pair_of(a.shalfedges), pair_of(b.shalfedges)),
            "shalfedges know their vertex", {{"vertex", v}});
  }
}

void check_planes_meet_point(const Complex& c, VertexId v, const SphereMapView& map, const Monitor& monitor) {
  const auto on = [&](PlaneId plane) { return side_of_plane(c.planes, plane, c.points, point_of(v), monitor) == 0; };
  for (std::size_t i = 0; i < map.svertices.size(); ++i) {
    require(on(map.svertices[i].p) && on(map.svertices[i].q), "planes of an svertex pass through its vertex",
            {{"vertex", v}, {"svertex", i}});
  }
  for (std::size_t i = 0; i < map.shalfedges.size(); ++i) {
    require(on(map.shalfedges[i].plane), "planes of facets pass through their vertices",
            {{"vertex", v}, {"shalfedge", i}});
  }
  for (std::size_t i = 0; i < map.sloops.size(); ++i) {
    require(on(map.sloops[i].plane), "the plane of a sloop passes through its vertex", {{"vertex", v}, {"sloop", i}});
  }
}

// A vertex is redundant if space looks the same from a point beside it on its lowest item: inside
// a volume, a facet, or an edge.
void check_vertex_needed(const Complex& c, VertexId v, const SphereMapView& map, const Monitor& monitor) {
  const LabelId mark = map.mark;
  if (map.svertices.empty()) {
    const LabelId around = map.sloops.empty() ? map.sfaces[0].mark : map.sloops[0].mark;
    require(around != mark, map.sloops.empty() ? "no redundant vertex in a volume" : "no redundant vertex in a facet",
            {{"vertex", v}});
    return;
  }
  if (map.svertices.size() != 2 || !map.sloops.empty()) return;
  if (map.svertices[0].mark != mark || map.svertices[1].mark != mark) return;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    if (map.shalfedges[e].source == map.target(e)) return;
  }
  const bool opposite = same_direction(direction_of(c.planes, map.svertices[0]),
                                       direction_of(c.planes, map.svertices[1]).negated(), monitor);
  require(!opposite, "no redundant vertex in an edge", {{"vertex", v}});
}

void check_sphere_maps(const Complex& c, const Monitor& monitor) {
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    const std::string broken = validate(c.planes, map, monitor);
    require(broken.empty(), broken.c_str(), {{"vertex", v}});
    check_planes_meet_point(c, v, map, monitor);
  }
}

void check_vertices(const Complex& c, const Monitor& monitor) {
  for (const VertexId v : c.vertex_ids()) check_vertex_needed(c, v, c.sphere_map(v), monitor);
  std::vector<VertexId> order(c.vertex_ids().begin(), c.vertex_ids().end());
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
    return compare_lexicographic(c.points, point_of(a), point_of(b), monitor) < 0;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    require(compare_lexicographic(c.points, point_of(order[i - 1]), point_of(order[i]), monitor) < 0,
            "vertices are distinct", {{"vertex", order[i - 1]}, {"vertex", order[i]}});
  }
}

// Sign of the coordinate of the direction along an axis.
int component_sign(const Direction& direction, std::size_t axis) { return sgn(direction.integers()[axis]); }

void check_edges(const Complex& c, const Monitor& monitor) {
  for (const HalfedgeId h : c.halfedge_ids()) {
    const HalfedgeId t = c.twin[h];
    require(c.twin.contains(t) && t != h && c.twin[t] == h, "twins of halfedges are mutual", {{"halfedge", h}});
    require(c.svertex(h).mark == c.svertex(t).mark, "both ends of an edge have one mark", {{"halfedge", h}});
    const PointId from = point_of(c.source(h));
    const PointId to = point_of(c.source(t));
    const Direction along = direction_of(c.planes, c.svertex(h));
    require(same_direction(along, direction_of(c.planes, c.svertex(t)).negated(), monitor),
            "twin halfedges have opposite directions", {{"halfedge", h}});
    require(side_of_plane(c.planes, c.svertex(h).p, c.points, to, monitor) == 0 &&
                side_of_plane(c.planes, c.svertex(h).q, c.points, to, monitor) == 0,
            "both ends of an edge lie on its line", {{"halfedge", h}});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      require(compare_coordinate(c.points, to, from, static_cast<int>(axis), monitor) == component_sign(along, axis),
              "an edge leads from its source to its target", {{"halfedge", h}});
    }
  }
}

// Tables of label functions have label_count entries, so a mark beyond them would be read from somewhere else.
void check_marks(const Complex& c) {
  require(c.label_count >= 2, "there are at least two labels", {});
  const auto known = [&c](LabelId mark) { return mark < c.label_count || mark == kOutside; };
  const char* const name = "marks are below the number of labels";
  for (const VertexId v : c.vertex_ids()) {
    require(known(c.mark(v)), name, {{"vertex", v}});
    SFaceId sface = c.vertices[v].sfaces;
    for (const SFace& f : c.sphere_map(v).sfaces) {
      require(known(f.mark), name, {{"sface", sface}});
      ++sface;
    }
  }
  for (const HalfedgeId h : c.halfedge_ids()) require(known(c.svertex(h).mark), name, {{"halfedge", h}});
  for (const SHalfedgeId e : c.shalfedge_ids()) require(known(c.shalfedge(e).mark), name, {{"shalfedge", e}});
  for (std::size_t l = 0; l < c.sloops.size(); ++l) require(known(c.sloops[l].mark), name, {{"sloop", l}});
  for (const FacetId f : c.facets.ids()) require(known(c.facets[f].mark), name, {{"facet", f}});
  for (const VolumeId v : c.volumes.ids()) require(known(c.volumes[v].mark), name, {{"volume", v}});
}

// Only a box has points and planes at infinity, and only beyond it is the mark kOutside.
void check_outside(const Complex& c) {
  require(!c.volumes.empty(), "there is an outer volume", {});
  for (const VertexId v : c.vertex_ids()) {
    require(c.has_box() || c.points.finite(point_of(v)), "infimaximal vertices need a box", {{"vertex", v}});
    require(c.mark(v) != kOutside, "only the outer volume is outside", {{"vertex", v}});
  }
  for (const HalfedgeId h : c.halfedge_ids()) {
    require(c.svertex(h).mark != kOutside, "only the outer volume is outside", {{"halfedge", h}});
  }
  for (const VolumeId i : c.volumes.ids()) {
    require(i == kOuterVolume || c.volumes[i].mark != kOutside, "only the outer volume is outside", {{"volume", i}});
  }
  for (const FacetId f : c.facets.ids()) {
    require(c.facets[f].mark != kOutside, "only the outer volume is outside", {{"facet", f}});
  }
}

std::string first_broken(const Complex& complex, bool sphere_maps, const Monitor& monitor) {
  const std::optional<Defect> defect = detail::defect_in([&] {
    check_array_sizes(complex);
    check_owners(complex);
    check_marks(complex);
    if (sphere_maps) check_sphere_maps(complex, monitor);
    check_vertices(complex, monitor);
    check_edges(complex, monitor);
    check_outside(complex);
    detail::check_facets(complex);
    detail::check_volumes(complex, monitor);
    detail::check_box(complex);
  });
  return defect ? defect->text() : std::string();
}

}  // namespace

std::string validate(const Complex& complex, const Monitor& monitor) { return first_broken(complex, true, monitor); }

std::string detail::validate_links(const Complex& complex, const Monitor& monitor) {
  return first_broken(complex, false, monitor);
}

}  // namespace nef
