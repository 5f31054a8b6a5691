// SPDX-License-Identifier: Apache-2.0
//
// A closed set has every vertex, edge and facet of its complex selected. Only these marks change here, and nothing can
// become redundant by it: an item that is redundant afterwards has the marks of all that it separates or joins, which
// were all selected before, so it was redundant before. Hence no simplification, as for the complement.
#include <algorithm>

#include "apps/minkowski/minkowski.h"
#include "nef/base/union_find.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// Selected sfaces and everything on the sphere around a vertex, joined where they touch.
class SphericalLink {
 public:
  explicit SphericalLink(const SphereMapView& map)
      : map_(map), sets_(map.svertices.size() + map.sloops.size() + map.sfaces.size()) {
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) sets_.unite(map.shalfedges[e].source, map.target(e));
    for (std::uint32_t l = 0; l < map.sloops.size(); l += 2) sets_.unite(loop(l), loop(l + 1));
    for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
      if (map.sfaces[f].mark == 0) continue;
      for (std::uint32_t i = 0; i < map.sfaces[f].entry_count; ++i) {
        sets_.unite(face(f), start(map.entries[map.sfaces[f].entries + i]));
      }
    }
  }

  [[nodiscard]] std::size_t component_count() {
    std::size_t count = 0;
    const auto is_hole = [&](std::uint32_t node) { return node >= face(0) && map_.sfaces[node - face(0)].mark == 0; };
    for (std::uint32_t node = 0; node < face(0) + map_.sfaces.size(); ++node) {
      if (!is_hole(node) && sets_.find(node) == node) ++count;
    }
    return count;
  }

 private:
  [[nodiscard]] std::uint32_t loop(std::uint32_t l) const {
    return static_cast<std::uint32_t>(map_.svertices.size()) + l;
  }
  [[nodiscard]] std::uint32_t face(std::uint32_t f) const {
    return static_cast<std::uint32_t>(map_.svertices.size() + map_.sloops.size()) + f;
  }
  [[nodiscard]] std::uint32_t start(const SFaceEntry& entry) const {
    switch (entry.kind) {
      case SFaceEntry::Kind::kCycle:
        return map_.shalfedges[entry.index].source;
      case SFaceEntry::Kind::kLoop:
        return loop(entry.index);
      default:
        return entry.index;
    }
  }

  const SphereMapView& map_;
  UnionFind sets_;
};

bool is_solid(const SphereMapView& map, std::uint32_t sface) {
  return map.sfaces[sface].mark != 0 && map.sfaces[sface].mark != kOutside;
}

// A facet with nothing of the set on either side.
bool is_thin(const SphereMapView& map, std::uint32_t shalfedge) {
  return !is_solid(map, map.shalfedges[shalfedge].sface) && !is_solid(map, map.shalfedges[shalfedge ^ 1U].sface);
}

// The point is in the closure of what is no solid part.
bool has_thin_part(const SphereMapView& map) {
  if (map.trivial()) return true;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    if (is_thin(map, e)) return true;
  }
  for (std::uint32_t l = 0; l < map.sloops.size(); l += 2) {
    if (!is_solid(map, map.sloops[l].sface) && !is_solid(map, map.sloops[l + 1].sface)) return true;
  }
  return std::any_of(map.svertices.begin(), map.svertices.end(), [](const SVertex& v) { return v.out == kNone; });
}

bool vertex_is_border(const SphereMapView& map) {
  if (!has_thin_part(map)) return true;
  if (map.trivial()) return false;  // an isolated point
  // By Alexander's duality the link has as many loops as there are holes beside the first.
  const auto holes = std::count_if(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark == 0; });
  return holes == 1 && SphericalLink(map).component_count() == 1;
}

bool edge_is_border(const SphereMapView& map, std::uint32_t svertex) {
  const std::uint32_t first = map.svertices[svertex].out;
  if (first == kNone) return false;  // a curve
  std::size_t thin = 0;
  bool solid = false;
  std::uint32_t e = first;
  do {
    thin += is_thin(map, e) ? 1 : 0;
    solid = solid || is_solid(map, map.shalfedges[e].sface);
    e = map.next_around(e);
  } while (e != first);
  return thin == 0 || (thin == 1 && !solid);
}

class BorderRemover {
 public:
  explicit BorderRemover(const Complex& c) : c_(c), result_(c) {}

  Complex run() {
    result_.facets.assign_marks([this](FacetId f) -> LabelId {
      const Facet facet = c_.facets[f];
      if (at_infinity(facet.plane)) return facet.mark;
      return thin(facet) ? 1 : 0;
    });
    rewrite_sphere_maps(result_, [this](VertexId v, SphereMapBuffer& map) {
      for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) map.shalfedges[e].mark = arc_mark(v, e);
      for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
        map.sloops[l].mark = result_.facets[facet_of(c_.sloop_facet[c_.vertices[v].sloops + l])].mark;
      }
      for (std::uint32_t s = 0; s < map.svertices.size(); ++s) map.svertices[s].mark = edge_mark(v, s);
      map.mark = vertex_mark(v);
    });
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool at_infinity(PlaneId plane) const { return c_.planes.infimaximal(plane); }
  [[nodiscard]] bool thin(const Facet& facet) const {
    return c_.volumes[facet.volume_above].mark == 0 && c_.volumes[facet.volume_below].mark == 0;
  }

  // New mark of the facet of a shalfedge at vertex v.
  [[nodiscard]] LabelId arc_mark(VertexId v, std::uint32_t e) const {
    return result_.facets[facet_of(c_.shalfedge_facet[c_.vertices[v].shalfedges + e])].mark;
  }

  [[nodiscard]] LabelId vertex_mark(VertexId v) const {
    if (!c_.points.finite(point_of(v))) return trace_of_vertex(v);
    return vertex_is_border(c_.sphere_map(v)) ? 0 : 1;
  }

  // New mark of the edge that begins at vertex v as svertex s.
  [[nodiscard]] LabelId edge_mark(VertexId v, std::uint32_t s) const {
    const SphereMapView map = c_.sphere_map(v);
    if (!on_wall(map, s)) return edge_is_border(map, s) ? 0 : 1;
    return trace(v, s);
  }

  [[nodiscard]] bool on_wall(const SphereMapView& map, std::uint32_t s) const {
    if (!c_.has_box() || map.svertices[s].out == kNone) return false;
    std::uint32_t e = map.svertices[s].out;
    do {
      if (at_infinity(map.shalfedges[e].plane)) return true;
      e = map.next_around(e);
    } while (e != map.svertices[s].out);
    return false;
  }

  // An edge in a wall of the infimaximal box is the trace of a facet, or of nothing.
  [[nodiscard]] LabelId trace(VertexId v, std::uint32_t s) const {
    const SphereMapView map = c_.sphere_map(v);
    std::uint32_t e = map.svertices[s].out;
    do {
      if (!at_infinity(map.shalfedges[e].plane)) return arc_mark(v, e);
      e = map.next_around(e);
    } while (e != map.svertices[s].out);
    return map.svertices[s].mark;
  }

  // A vertex in a wall is the trace of an edge, or of a facet, or of nothing.
  [[nodiscard]] LabelId trace_of_vertex(VertexId v) const {
    const SphereMapView map = c_.sphere_map(v);
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      if (!on_wall(map, s)) return edge_mark(v, s);
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      if (!at_infinity(map.shalfedges[e].plane)) return arc_mark(v, e);
    }
    return map.mark;
  }

  const Complex& c_;
  Complex result_;
};

}  // namespace

Polyhedron without_border(const Polyhedron& closed) { return Polyhedron(BorderRemover(closed.complex()).run()); }

}  // namespace nef::minkowski
