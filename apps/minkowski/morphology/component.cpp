// SPDX-License-Identifier: Apache-2.0
//
// Two items of a set are connected directly if one lies in the boundary of the other. Every such pair but a facet and
// the volumes beside it meets at a vertex, and the sphere maps there tell all of them.
#include <algorithm>
#include <vector>

#include "apps/minkowski/morphology.h"
#include "nef/base/union_find.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

constexpr LabelId kIn = 1;
constexpr LabelId kElsewhere = 2;  // in the set, but not in the component

// Connects the items of a set.
class Connection {
 public:
  explicit Connection(const Complex& c)
      : c_(c),
        first_edge_(c.vertex_count()),
        first_facet_(first_edge_ + c.svertex_count()),
        first_volume_(first_facet_ + c.facet_count()),
        sets_(first_volume_ + c.volume_count()) {
    for (const VertexId v : c.vertex_ids()) connect_at(v);
    for (const FacetId f : c.facets.ids()) {
      for (const VolumeId volume : {c.facets[f].volume_above, c.facets[f].volume_below}) {
        join(of_facet(f), of_volume(volume));
      }
    }
  }

  // Numbers of items.
  [[nodiscard]] std::uint32_t of_vertex(VertexId v) const { return v.index(); }
  [[nodiscard]] std::uint32_t of_edge(HalfedgeId halfedge) const {
    return static_cast<std::uint32_t>(first_edge_ + c_.edge(halfedge).index());
  }
  [[nodiscard]] std::uint32_t of_facet(FacetId f) const { return static_cast<std::uint32_t>(first_facet_ + f.index()); }
  [[nodiscard]] std::uint32_t of_volume(VolumeId v) const {
    return static_cast<std::uint32_t>(first_volume_ + v.index());
  }

  [[nodiscard]] bool is_selected(std::uint32_t item) const {
    if (item < first_edge_) return c_.mark(VertexId{item}) == kIn;
    if (item < first_facet_) return c_.svertex(HalfedgeId{item - first_edge_}).mark == kIn;
    if (item < first_volume_) return c_.facets[FacetId{item - first_facet_}].mark == kIn;
    return c_.volumes[VolumeId{item - first_volume_}].mark == kIn;
  }
  std::uint32_t component(std::uint32_t item) { return sets_.find(item); }

  // Calls visit for all items of the sphere map of a vertex.
  template <typename Visit>
  void for_each_at(VertexId v, Visit&& visit) const {
    visit(of_vertex(v));
    for (const HalfedgeId h : c_.halfedges(v)) visit(of_edge(h));
    for (const SHalfedgeId e : c_.shalfedges(v)) {
      visit(of_facet(facet_of(c_.shalfedge_facet[e])));
    }
    for (std::uint32_t l = c_.vertices[v].sloops; l < c_.vertices[v.next()].sloops; ++l) {
      visit(of_facet(facet_of(c_.sloop_facet[l])));
    }
    for (const SFaceId f : c_.sfaces(v)) {
      visit(of_volume(c_.sface_volume(f)));
    }
  }

 private:
  void join(std::uint32_t x, std::uint32_t y) {
    if (is_selected(x) && is_selected(y)) sets_.unite(x, y);
  }

  void connect_at(VertexId v) {
    for_each_at(v, [&](std::uint32_t item) { join(of_vertex(v), item); });
    for (const SHalfedgeId e : c_.shalfedges(v)) {
      const std::uint32_t edge = of_edge(c_.corner_halfedge(e));
      join(edge, of_facet(facet_of(c_.shalfedge_facet[e])));
      join(edge, of_volume(c_.sface_volume(c_.shalfedge_sface(e))));
    }
    for (const HalfedgeId h : c_.halfedges(v)) {
      const SVertex& sv = c_.svertex(h);
      if (sv.out == kNone) join(of_edge(h), of_volume(c_.sface_volume(c_.vertices[v].sfaces + sv.sface)));
    }
  }

  const Complex& c_;
  std::size_t first_edge_, first_facet_, first_volume_;
  UnionFind sets_;
};

std::uint32_t item_at(const Polyhedron& a, const Connection& connection, const Rational3& point,
                      const Monitor& monitor) {
  const Location at = locate(a, point, monitor);
  switch (at.kind) {
    case Location::Kind::kVertex:
      return connection.of_vertex(at.vertex());
    case Location::Kind::kEdge:
      return connection.of_edge(at.halfedge());
    case Location::Kind::kFacet:
      return connection.of_facet(at.facet());
    default:
      return connection.of_volume(at.volume());
  }
}

// The same items, those of the set that are not to be kept labelled kElsewhere.
Complex labelled(const Complex& original, const Connection& connection, const std::vector<std::uint8_t>& kept) {
  Complex c = original;
  const auto mark = [&](LabelId& label, std::uint32_t item) {
    if (label == kIn && kept[item] == 0) label = kElsewhere;
  };
  rewrite_sphere_maps(c, [&](VertexId v, SphereMapBuffer& map) {
    const VertexRecord& record = original.vertices[v];
    mark(map.mark, connection.of_vertex(v));
    for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
      mark(map.sfaces[f].mark, connection.of_volume(original.sface_volume(record.sfaces + f)));
    }
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      mark(map.svertices[s].mark, connection.of_edge(record.svertices + s));
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      mark(map.shalfedges[e].mark, connection.of_facet(facet_of(original.shalfedge_facet[record.shalfedges + e])));
    }
    for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
      mark(map.sloops[l].mark, connection.of_facet(facet_of(original.sloop_facet[record.sloops + l])));
    }
  });
  c.facets.assign_marks([&](FacetId f) {
    LabelId label = c.facets[f].mark;
    mark(label, connection.of_facet(f));
    return label;
  });
  for (const VolumeId v : c.volumes.ids()) mark(c.volumes[v].mark, connection.of_volume(v));
  c.label_count = 3;
  return c;
}

}  // namespace

Polyhedron component_of(const Polyhedron& a, const std::optional<Rational3>& point, const Monitor& monitor) {
  const Complex& c = a.complex();
  Connection connection(c);
  const std::size_t items = c.vertex_count() + c.svertex_count() + c.facet_count() + c.volume_count();
  std::vector<std::uint8_t> wanted(items, 0);  // per representative
  bool any = false;
  const auto want = [&](std::uint32_t item) {
    if (!connection.is_selected(item)) return;
    wanted[connection.component(item)] = 1;
    any = true;
  };
  if (point) {
    want(item_at(a, connection, *point, monitor));
  } else {
    want(connection.of_volume(kOuterVolume));
    for (const VertexId v : c.vertex_ids()) {
      if (!c.points.finite(point_of(v))) connection.for_each_at(v, want);
    }
  }
  if (!any) return {};
  std::vector<std::uint8_t> kept(items, 0);
  for (std::uint32_t item = 0; item < items; ++item) kept[item] = wanted[connection.component(item)];
  const auto without_others = [](LabelId own, LabelId) -> LabelId { return own == kElsewhere ? 0 : own; };
  return overlay(Polyhedron(labelled(c, connection, kept)), Polyhedron::everything(), without_others, monitor);
}

}  // namespace nef::minkowski
