// SPDX-License-Identifier: Apache-2.0
//
// Every incidence of two items of a complex is seen in the sphere map of some vertex, so the components of a set are
// those of a graph that the sphere maps draw. A piece is made from the sphere maps of the vertices that it touches,
// with the marks of all other items cleared.
#include "nef/parts/split.h"

#include <algorithm>
#include <set>
#include <utility>

#include "nef/base/union_find.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// The items around a vertex, by their local numbers, and whether they are in a piece.
struct Kept {
  std::vector<bool> sfaces;
  std::vector<bool> arcs;  // shalfedge 2i and its twin
  std::vector<bool> svertices;
  bool circle = false;
  bool centre = false;
};

// A piece in the making: the vertices that it touches, increasing.
struct Piece {
  std::vector<VertexId> vertices;
  LabelId outer = 0;  // the mark of the outer volume, where that is in the piece
};

class PieceMaker {
 public:
  PieceMaker(const Complex& complex, const Monitor& monitor) : c_(complex), monitor_(monitor) {
    for (const VertexId v : c_.vertex_ids()) {
      if (is_box_vertex(c_, v)) box_vertices_.push_back(v);
    }
  }

  // `kept(vertex, map, out)` says what the piece has around a vertex.
  template <typename KeptAround>
  Polyhedron make(const Piece& piece, const KeptAround& kept) {
    std::vector<VertexId> vertices = piece.vertices;
    const bool at_infinity =
        std::any_of(vertices.begin(), vertices.end(), [this](VertexId v) { return is_box_vertex(c_, v); });
    if (at_infinity) {
      vertices.insert(vertices.end(), box_vertices_.begin(), box_vertices_.end());
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
    PlaneTable planes;
    ComplexBuilder result(planes, monitor_);
    row_.resize(c_.planes.size(), kNone);
    for (const VertexId v : vertices) {
      const SphereMapView map = c_.sphere_map(v);
      kept(v, map, kept_);
      draw(map);
      drawing_.sort_around_nodes(c_.planes, monitor_);
      drawing_.simplify_and_assemble(c_.planes, out_, monitor_);
      rename_planes(planes);
      result.add(c_.points, point_of(v), out_.view());
    }
    for (const std::uint32_t row : rows_in_use_) row_[row] = kNone;
    rows_in_use_.clear();
    return Polyhedron(result.finish(at_infinity ? kOutside : piece.outer));
  }

 private:
  void draw(const SphereMapView& map) {
    drawing_.load(c_.planes, map);
    const auto cleared = [](LabelId mark, bool keep) { return keep || mark == kOutside ? mark : LabelId{0}; };
    const auto sface = [&](std::uint32_t i) { return cleared(map.sfaces[i].mark, kept_.sfaces[i]); };
    drawing_.centre = cleared(drawing_.centre, kept_.centre);
    drawing_.background = sface(0);
    for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
      drawing_.nodes[i].mark = cleared(map.svertices[i].mark, kept_.svertices[i]);
      if (map.svertices[i].out == kNone) drawing_.nodes[i].around = sface(map.svertices[i].sface);
    }
    for (std::uint32_t i = 0; i < drawing_.arcs.size(); ++i) {
      drawing_.arcs[i].mark = cleared(drawing_.arcs[i].mark, kept_.arcs[i]);
      drawing_.arcs[i].left = sface(map.shalfedges[2 * i].sface);
      drawing_.arcs[i].right = sface(map.shalfedges[2 * i + 1].sface);
    }
    if (!map.sloops.empty()) {
      drawing_.circle.mark = cleared(drawing_.circle.mark, kept_.circle);
      drawing_.circle.left = sface(map.sloops[0].sface);
      drawing_.circle.right = sface(map.sloops[1].sface);
    }
  }

  // A piece has a table of its own planes, so that many small ones cost no more than their sizes.
  void rename_planes(PlaneTable& planes) {
    for_each_plane(out_, [&](PlaneId& plane) {
      std::uint32_t& row = row_[plane.row()];
      if (row == kNone) {
        row = planes.append_new(c_.planes, plane.row());
        rows_in_use_.push_back(plane.row());
      }
      plane = plane.in_row(row);
    });
  }

  const Complex& c_;
  Monitor monitor_;
  std::vector<VertexId> box_vertices_;
  std::vector<std::uint32_t> row_;  // of a plane in the piece at hand
  std::vector<std::uint32_t> rows_in_use_;
  Kept kept_;
  Arrangement drawing_;
  SphereMapBuffer out_;
};

// Numbers for volumes, facets, edges and vertices in one row, and which of them belong together.
class Components {
 public:
  explicit Components(const Complex& complex)
      : c_(complex),
        facets_(static_cast<std::uint32_t>(c_.volume_count())),
        edges_(facets_ + static_cast<std::uint32_t>(c_.facet_count())),
        vertices_(edges_ + static_cast<std::uint32_t>(c_.svertex_count())),
        sets_(vertices_ + c_.vertex_count()) {
    for (const VertexId v : c_.vertex_ids()) join_around(v);
  }

  // The component of an item, or kNone for an item that is not in the set.
  std::uint32_t of_volume(VolumeId volume) { return of(volume.index(), c_.volumes[volume].mark); }
  std::uint32_t of_sface(VertexId v, std::uint32_t sface) {
    return of_volume(c_.sface_volume(c_.vertices[v].sfaces + sface));
  }
  std::uint32_t of_arc(VertexId v, std::uint32_t shalfedge) {
    return of_facet(facet_of(c_.shalfedge_facet[c_.vertices[v].shalfedges + shalfedge]));
  }
  std::uint32_t of_circle(VertexId v) { return of_facet(facet_of(c_.sloop_facet[c_.vertices[v].sloops])); }
  std::uint32_t of_svertex(VertexId v, std::uint32_t svertex) { return of_edge(c_.halfedges(v)[svertex]); }
  std::uint32_t of_vertex(VertexId v) { return of(vertices_ + v.index(), c_.mark(v)); }
  std::uint32_t of_item(const ItemRef& item) {
    if (item.kind == ItemRef::Kind::kVertex) return of_vertex(item.vertex());
    if (item.kind == ItemRef::Kind::kEdge) return of_edge(item.halfedge());
    return item.kind == ItemRef::Kind::kFacet ? of_facet(item.facet()) : of_volume(item.volume());
  }

  // What some components have around a vertex.
  template <typename Wanted>
  void keep(const Wanted& wanted, VertexId v, const SphereMapView& map, Kept& out) {
    out.sfaces.resize(map.sfaces.size());
    out.arcs.resize(map.shalfedges.size() / 2);
    out.svertices.resize(map.svertices.size());
    for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) out.sfaces[i] = wanted(of_sface(v, i));
    for (std::uint32_t i = 0; i < out.arcs.size(); ++i) out.arcs[i] = wanted(of_arc(v, 2 * i));
    for (std::uint32_t i = 0; i < map.svertices.size(); ++i) out.svertices[i] = wanted(of_svertex(v, i));
    out.circle = !map.sloops.empty() && wanted(of_circle(v));
    out.centre = wanted(of_vertex(v));
  }

  // The components around a vertex, each once.
  void around(VertexId v, std::vector<std::uint32_t>& out) {
    const SphereMapView map = c_.sphere_map(v);
    out.clear();
    const auto add = [&out](std::uint32_t component) {
      if (component != kNone) out.push_back(component);
    };
    for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) add(of_sface(v, i));
    for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) add(of_arc(v, i));
    for (std::uint32_t i = 0; i < map.svertices.size(); ++i) add(of_svertex(v, i));
    if (!map.sloops.empty()) add(of_circle(v));
    add(of_vertex(v));
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

 private:
  std::uint32_t of(std::uint32_t item, LabelId mark) { return is_selected(mark) ? sets_.find(item) : kNone; }
  std::uint32_t of_facet(FacetId facet) { return of(facets_ + facet.index(), c_.facets[facet].mark); }
  std::uint32_t of_edge(HalfedgeId h) { return of(edges_ + c_.edge(h).index(), c_.svertex(h).mark); }
  void join(std::uint32_t a, std::uint32_t b) {
    if (a != kNone && b != kNone) sets_.unite(a, b);
  }

  void join_around(VertexId v) {
    const SphereMapView map = c_.sphere_map(v);
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      join(of_arc(v, e), of_sface(v, map.shalfedges[e].sface));
      join(of_arc(v, e), of_svertex(v, map.shalfedges[e].source));
      join(of_sface(v, map.shalfedges[e].sface), of_svertex(v, map.shalfedges[e].source));
    }
    for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
      if (map.svertices[s].out == kNone) join(of_svertex(v, s), of_sface(v, map.svertices[s].sface));
      join(of_vertex(v), of_svertex(v, s));
    }
    for (const SLoop& loop : map.sloops) join(of_circle(v), of_sface(v, loop.sface));
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) join(of_vertex(v), of_arc(v, e));
    if (!map.sloops.empty()) join(of_vertex(v), of_circle(v));
    for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) join(of_vertex(v), of_sface(v, i));
  }

  const Complex& c_;
  std::uint32_t facets_;
  std::uint32_t edges_;
  std::uint32_t vertices_;
  UnionFind sets_;
};

// What the set has of a volume and its boundary around a vertex.
void keep_volume(const Complex& c, VolumeId volume, VertexId v, const SphereMapView& map, Kept& out) {
  out.sfaces.assign(map.sfaces.size(), false);
  out.arcs.assign(map.shalfedges.size() / 2, false);
  out.svertices.assign(map.svertices.size(), false);
  out.circle = out.centre = false;
  for (std::uint32_t i = 0; i < map.sfaces.size(); ++i) {
    out.sfaces[i] = c.sface_volume(c.vertices[v].sfaces + i) == volume;
    out.centre = out.centre || out.sfaces[i];
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    if (!out.sfaces[map.shalfedges[e].sface]) continue;
    out.arcs[e / 2] = true;
    out.svertices[map.shalfedges[e].source] = true;
  }
  for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
    if (map.svertices[s].out == kNone && out.sfaces[map.svertices[s].sface]) out.svertices[s] = true;
  }
  for (const SLoop& loop : map.sloops) out.circle = out.circle || out.sfaces[loop.sface];
}

}  // namespace

std::vector<Polyhedron> split(const Polyhedron& a, const Monitor& monitor) {
  const Complex& c = a.complex();
  Components components(c);
  std::vector<std::uint32_t> number;  // of the piece of a component
  std::vector<std::uint32_t> component_of;
  std::vector<Piece> pieces;
  const auto piece = [&](std::uint32_t component) -> Piece& {
    if (number.size() <= component) number.resize(component + std::size_t{1}, kNone);
    if (number[component] == kNone) {
      number[component] = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
      component_of.push_back(component);
    }
    return pieces[number[component]];
  };
  if (const std::uint32_t outer = components.of_volume(kOuterVolume); outer != kNone) {
    piece(outer).outer = c.volumes[kOuterVolume].mark;
  }
  std::vector<std::uint32_t> found;
  for (const VertexId v : c.vertex_ids()) {
    components.around(v, found);
    for (const std::uint32_t component : found) piece(component).vertices.push_back(v);
  }
  std::vector<std::uint32_t> order(pieces.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return component_of[i] < component_of[j]; });
  std::vector<Polyhedron> result;
  PieceMaker maker(c, monitor);
  for (const std::uint32_t i : order) {
    result.push_back(maker.make(pieces[i], [&](VertexId v, const SphereMapView& map, Kept& out) {
      components.keep([&](std::uint32_t component) { return component == component_of[i]; }, v, map, out);
    }));
  }
  return result;
}

Polyhedron component_of(const Polyhedron& a, const std::optional<Rational3>& point, const Monitor& monitor) {
  const Complex& c = a.complex();
  Components components(c);
  std::set<std::uint32_t> wanted{point ? components.of_item(locate(a, *point, monitor))
                                       : components.of_volume(kOuterVolume)};
  std::vector<std::uint32_t> found;
  for (const VertexId v : c.vertex_ids()) {
    if (point || !is_box_vertex(c, v)) continue;
    components.around(v, found);
    wanted.insert(found.begin(), found.end());
  }
  wanted.erase(kNone);
  if (wanted.empty()) return {};
  const auto is_wanted = [&wanted](std::uint32_t component) { return wanted.contains(component); };
  Piece piece;
  if (is_wanted(components.of_volume(kOuterVolume))) piece.outer = c.volumes[kOuterVolume].mark;
  for (const VertexId v : c.vertex_ids()) {
    components.around(v, found);
    if (std::any_of(found.begin(), found.end(), is_wanted)) piece.vertices.push_back(v);
  }
  return PieceMaker(c, monitor).make(piece, [&](VertexId v, const SphereMapView& map, Kept& out) {
    components.keep(is_wanted, v, map, out);
  });
}

std::vector<Polyhedron> split_volumes(const Polyhedron& a, const Monitor& monitor) {
  const Complex& c = a.complex();
  IndexedVector<VolumeId, Piece> pieces(c.volume_count());
  pieces[kOuterVolume].outer = is_selected(c.volumes[kOuterVolume].mark) ? c.volumes[kOuterVolume].mark : LabelId{0};
  for (const VertexId v : c.vertex_ids()) {
    for (const SFaceId sface : c.sfaces(v)) {
      std::vector<VertexId>& vertices = pieces[c.sface_volume(sface)].vertices;
      if (vertices.empty() || vertices.back() != v) vertices.push_back(v);
    }
  }
  std::vector<Polyhedron> result;
  PieceMaker maker(c, monitor);
  for (const VolumeId volume : c.volumes.ids()) {
    if (!is_selected(c.volumes[volume].mark)) continue;
    result.push_back(maker.make(
        pieces[volume], [&](VertexId v, const SphereMapView& map, Kept& out) { keep_volume(c, volume, v, map, out); }));
  }
  return result;
}

}  // namespace nef
