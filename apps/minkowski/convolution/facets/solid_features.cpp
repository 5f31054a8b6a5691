// SPDX-License-Identifier: Apache-2.0
//
// Facets are cut into convex pieces once, and keep their rings where they are polygons of several pieces; one with
// nothing of a solid on either side is added from both sides. Around each edge at most one free wedge is larger than a
// half-turn; the normals of its two planes are the ends of the edge's arc, and opposite at the border of a sheet.
// Directions find their integers at the end, so that threads may share them. O(n), and what triangulations take.
#include "apps/minkowski/convolution/facets/solid_features.h"

#include <algorithm>
#include <tuple>

#include "apps/minkowski/convolution/facets/convex_pieces.h"
#include "nef/mesh/edge_order.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// True if rings, or one of them, walk a side both ways.
bool walks_a_side_twice(const std::vector<std::vector<std::uint32_t>>& rings) {
  std::vector<std::uint64_t> sides;
  for (const std::vector<std::uint32_t>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t u = ring[i];
      const std::uint32_t v = ring[(i + 1) % ring.size()];
      sides.push_back(edge_key(u, v));
    }
  }
  std::sort(sides.begin(), sides.end());
  return std::adjacent_find(sides.begin(), sides.end()) != sides.end();
}

}  // namespace

bool ConvexEdge::touches(const Direction& normal, const Monitor& monitor) const {
  if (is_bare) return true;
  return sign_of_determinant(line, first, normal, monitor) > 0 && sign_of_determinant(line, normal, last, monitor) > 0;
}

SolidFeatures::SolidFeatures(const Polyhedron& solid, const Monitor& monitor)
    : c_(solid.complex()), points_(c_.points.rationals()) {
  find_marks();
  directions_.reserve(c_.svertex_count());
  for (const HalfedgeId h : c_.halfedge_ids()) directions_.push_back(direction_of(c_.planes, c_.svertex(h)));
  add_facets(monitor);
  for (const VertexId v : c_.vertex_ids()) {
    const IdRange<HalfedgeId> halfedges = c_.halfedges(v);
    for (const HalfedgeId h : halfedges) {
      if (h < c_.twin[h]) add_edge(v, halfedges.position(h), monitor);
    }
  }
  know_integers();
}

// Directions find their integers when they are first asked, which several threads must not do at once.
void SolidFeatures::know_integers() const {
  for (const Direction& d : directions_) std::ignore = d.integers();
  for (const SolidFacet& f : facets_) std::ignore = f.normal.integers();
  for (const ConvexEdge& e : edges_) {
    for (const Direction* d : {&e.line, &e.first, &e.last}) std::ignore = d->integers();
  }
}

void SolidFeatures::find_marks() {
  bool any = false;
  bool all = true;
  const auto look_at = [&](LabelId mark) {
    any = any || mark != 0;
    all = all && mark != 0;
  };
  for (const Facet& f : c_.facets) look_at(f.mark);
  for (const HalfedgeId h : c_.halfedge_ids()) look_at(c_.svertex(h).mark);
  for (const VertexId v : c_.vertex_ids()) {
    look_at(c_.mark(v));
    for (const SLoop& loop : c_.sphere_map(v).sloops) {
      has_plain_facets_ = has_plain_facets_ && loop.mark == c_.mark(v);
    }
  }
  marks_ = all ? BoundaryMarks::kAll : any ? BoundaryMarks::kMixed : BoundaryMarks::kNone;
  if (marks_ != BoundaryMarks::kMixed) return;
  for (const VertexId v : c_.vertex_ids()) {
    for (const HalfedgeId h : c_.halfedges(v)) {
      const VertexId w = c_.target(h);
      if (v < w) edge_marks_.emplace(pair_key(v.index(), w.index()), c_.svertex(h).mark != 0 ? 1 : 0);
    }
  }
}

// What is no edge is a cut through the facet.
void SolidFeatures::mark_sides(FacetPiece& piece) const {
  piece.sides.assign(piece.ring.size(), piece.mark);
  if (marks_ != BoundaryMarks::kMixed) return;
  for (std::size_t i = 0; i < piece.ring.size(); ++i) {
    const std::uint32_t u = piece.ring[i];
    const std::uint32_t w = piece.ring[i + 1 < piece.ring.size() ? i + 1 : 0];
    const auto edge = edge_marks_.find(edge_key(u, w));
    if (edge != edge_marks_.end()) piece.sides[i] = edge->second;
  }
}

void SolidFeatures::add_facets(const Monitor& monitor) {
  const MeshPoints points(c_.points);
  ConvexPieces pieces(points, monitor);
  for (const FacetId f : c_.facets.ids()) {
    const Facet& facet = c_.facets[f];
    const bool solid_above = c_.volumes[facet.volume_above].mark != 0;
    const bool solid_below = c_.volumes[facet.volume_below].mark != 0;
    std::vector<std::vector<std::uint32_t>> rings;
    for (const CycleId cycle : facet.cycles()) {
      std::vector<std::uint32_t>& ring = rings.emplace_back();
      for (const SHalfedgeId corner : c_.corners_of(cycle)) ring.push_back(c_.shalfedge_vertex(corner).index());
    }
    const std::vector<std::vector<std::uint32_t>> cut = pieces.cut(rings, projection_axis(c_.planes, facet.plane));
    if (!solid_above) add_facet(facet, false, cut, rings);
    if (!solid_below) add_facet(facet, true, cut, rings);
  }
}

// `rings` and what they are cut into are counterclockwise from above.
void SolidFeatures::add_facet(const Facet& facet, bool solid_above,
                              const std::vector<std::vector<std::uint32_t>>& pieces,
                              const std::vector<std::vector<std::uint32_t>>& rings) {
  SolidFacet& added = facets_.emplace_back();
  added.normal = Direction::normal(c_.planes, solid_above ? facet.plane.opposite() : facet.plane);
  for (const std::vector<std::uint32_t>& ring : pieces) {
    FacetPiece& piece = added.pieces.emplace_back();
    piece.ring = ring;
    if (solid_above) std::reverse(piece.ring.begin(), piece.ring.end());
    piece.mark = facet.mark != 0 ? 1 : 0;
    mark_sides(piece);
  }
  if (added.pieces.size() == 1 || walks_a_side_twice(rings)) return;
  added.rings = rings;
  for (std::vector<std::uint32_t>& ring : added.rings) {
    if (solid_above) std::reverse(ring.begin(), ring.end());
  }
}

// At most one wedge around an edge is free and larger than a half-turn.
void SolidFeatures::add_edge(VertexId vertex, std::uint32_t svertex, const Monitor& monitor) {
  const SphereMapView map = c_.sphere_map(vertex);
  const HalfedgeId halfedge = c_.halfedges(vertex)[svertex];
  const Direction& line = directions_[halfedge];
  const std::uint32_t out = map.svertices[svertex].out;
  const auto mark = static_cast<std::uint8_t>(map.svertices[svertex].mark != 0 ? 1 : 0);
  if (out == kNone) {
    edges_.push_back({vertex.index(), c_.target(halfedge).index(), line, line, line, mark, true});
    return;
  }
  std::uint32_t e = out;
  std::size_t solid = 0;
  do {
    solid += map.sfaces[map.shalfedges[e].sface].mark != 0 ? 1 : 0;
    e = map.next_around(e);
  } while (e != out);
  has_simple_edges_ = has_simple_edges_ && solid == 1;
  do {
    const std::uint32_t next = map.next_around(e);
    const PlaneId first = map.shalfedges[e].plane;
    const PlaneId last = map.shalfedges[next].plane;
    if (map.sfaces[map.shalfedges[e].sface].mark == 0 &&
        (next == e || orientation_around(c_.planes, line, first, last, monitor) < 0)) {
      edges_.push_back({vertex.index(), c_.target(halfedge).index(), line, Direction::normal(c_.planes, first),
                        Direction::normal(c_.planes, last.opposite()), mark});
      return;
    }
    e = next;
  } while (e != out);
}

bool SolidFeatures::is_peak(std::uint32_t number, const Direction& up, const Monitor& monitor) const {
  const VertexId vertex{number};
  if (c_.vertices[vertex].svertices == c_.vertices[vertex.next()].svertices)
    return c_.sphere_map(vertex).trivial();  // a single point, or inside a facet
  for (const HalfedgeId h : c_.halfedges(vertex)) {
    if (sign_of_dot(directions_[h], up, monitor) >= 0) return false;
  }
  // All edges go down, so the open upper half-sphere is in one sface.
  const SphereMapView map = c_.sphere_map(vertex);
  return mark_at(map, locate(c_.planes, map, up, monitor)) == 0;
}

}  // namespace nef::minkowski
