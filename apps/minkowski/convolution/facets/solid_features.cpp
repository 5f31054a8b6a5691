// SPDX-License-Identifier: Apache-2.0
//
// Facets are cut into convex pieces once, and keep their rings where they are polygons of several pieces; one with
// nothing of a solid on either side is added from both sides. Around each edge at most one free wedge is larger than a
// half-turn; the normals of its two planes are the ends of the edge's arc, and opposite at the border of a sheet.
// Facets and edges are found in chunks, on several threads, and put together in order. O(n), and what
// triangulations take.
#include "apps/minkowski/convolution/facets/solid_features.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "apps/minkowski/convolution/facets/convex_pieces.h"
#include "nef/base/fast_path.h"
#include "nef/base/threads/parallel.h"
#include "nef/mesh/edge_order.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

constexpr std::size_t kItemsAtOnce = 1024;

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

SolidFeatures::SolidFeatures(const Polyhedron& solid, const Monitor& monitor)
    : c_(solid.complex()), points_(c_.vertex_count()), lines_(c_, monitor) {
  parallel_for_ranges(points_.size(), kItemsAtOnce, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
    for (std::size_t i = from; i < to; ++i) points_[i] = c_.points.rational(PointId{static_cast<std::uint32_t>(i)});
  });
  find_marks();
  count_cells();
  find_facets(monitor);
  find_edges(monitor);
  top_.assign(c_.vertex_count(), 0);
}

// But for those at edges.
void SolidFeatures::count_cells() {
  const auto is_solid = [this](VolumeId v) { return c_.volumes[v].mark != 0; };
  for (const VolumeId v : c_.volumes.ids()) cells_ += is_solid(v) ? 1 : 0;
  for (const Facet& f : c_.facets) cells_ += is_solid(f.volume_above) || is_solid(f.volume_below) ? 0 : 1;
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

void SolidFeatures::find_facets(const Monitor& monitor) {
  const MeshPoints points(c_.points);
  std::vector<std::vector<SolidFacet>> parts((c_.facets.size() + kItemsAtOnce - 1) / kItemsAtOnce);
  parallel_for_ranges(c_.facets.size(), kItemsAtOnce, monitor,
                      [&](std::size_t from, std::size_t to, const Monitor& own) {
                        ConvexPieces pieces(points, own);
                        std::vector<SolidFacet>& part = parts[from / kItemsAtOnce];
                        for (std::size_t i = from; i < to; ++i) {
                          const Facet facet = c_.facets[FacetId{static_cast<std::uint32_t>(i)}];
                          const bool solid_above = c_.volumes[facet.volume_above].mark != 0;
                          const bool solid_below = c_.volumes[facet.volume_below].mark != 0;
                          std::vector<std::vector<std::uint32_t>> rings;
                          for (const CycleId cycle : facet.cycles()) {
                            std::vector<std::uint32_t>& ring = rings.emplace_back();
                            for (const SHalfedgeId corner : c_.corners_of(cycle))
                              ring.push_back(c_.shalfedge_vertex(corner).index());
                          }
                          const std::vector<std::vector<std::uint32_t>> cut =
                              pieces.cut(rings, projection_axis(c_.planes, facet.plane));
                          if (!solid_above) part.push_back(facet_of(facet, false, cut, rings));
                          if (!solid_below) part.push_back(facet_of(facet, true, cut, rings));
                        }
                      });
  std::size_t count = 0;
  for (const std::vector<SolidFacet>& part : parts) count += part.size();
  facets_.reserve(count);
  for (std::vector<SolidFacet>& part : parts) std::move(part.begin(), part.end(), std::back_inserter(facets_));
}

// `rings` and what they are cut into are counterclockwise from above.
SolidFacet SolidFeatures::facet_of(const Facet& facet, bool solid_above,
                                   const std::vector<std::vector<std::uint32_t>>& pieces,
                                   const std::vector<std::vector<std::uint32_t>>& rings) const {
  SolidFacet result;
  result.plane = solid_above ? facet.plane.opposite() : facet.plane;
  for (const std::vector<std::uint32_t>& ring : pieces) {
    FacetPiece& piece = result.pieces.emplace_back();
    piece.ring = ring;
    if (solid_above) std::reverse(piece.ring.begin(), piece.ring.end());
    piece.mark = facet.mark != 0 ? 1 : 0;
    mark_sides(piece);
  }
  if (result.pieces.size() == 1 || walks_a_side_twice(rings)) return result;
  result.rings = rings;
  for (std::vector<std::uint32_t>& ring : result.rings) {
    if (solid_above) std::reverse(ring.begin(), ring.end());
  }
  return result;
}

void SolidFeatures::find_edges(const Monitor& monitor) {
  std::vector<Edges> parts((c_.vertex_count() + kItemsAtOnce - 1) / kItemsAtOnce);
  parallel_for_ranges(c_.vertex_count(), kItemsAtOnce, monitor,
                      [&](std::size_t from, std::size_t to, const Monitor& own) {
                        Edges& part = parts[from / kItemsAtOnce];
                        for (std::size_t i = from; i < to; ++i) {
                          const VertexId v{static_cast<std::uint32_t>(i)};
                          const IdRange<HalfedgeId> halfedges = c_.halfedges(v);
                          for (const HalfedgeId h : halfedges) {
                            if (h < c_.twin[h]) add_edge(v, halfedges.position(h), part, own);
                          }
                        }
                      });
  std::size_t count = 0;
  for (const Edges& part : parts) count += part.convex.size();
  edges_.reserve(count);
  for (const Edges& part : parts) {
    edges_.insert(edges_.end(), part.convex.begin(), part.convex.end());
    cells_ += part.cells;
    has_simple_edges_ = has_simple_edges_ && part.are_simple;
  }
}

// At most one wedge around an edge is free and larger than a half-turn.
void SolidFeatures::add_edge(VertexId vertex, std::uint32_t svertex, Edges& edges, const Monitor& monitor) const {
  const SphereMapView map = c_.sphere_map(vertex);
  const HalfedgeId halfedge = c_.halfedges(vertex)[svertex];
  const std::uint32_t line = lines_.edge_of(halfedge);
  const std::uint32_t out = map.svertices[svertex].out;
  const auto mark = static_cast<std::uint8_t>(map.svertices[svertex].mark != 0 ? 1 : 0);
  if (out == kNone) {
    edges.convex.push_back({vertex.index(), c_.target(halfedge).index(), line, PlaneId(), PlaneId(), mark, true});
    ++edges.cells;
    return;
  }
  const Direction along = direction_of(c_.planes, map.svertices[svertex]);
  std::uint32_t e = out;
  std::size_t solid = 0;
  do {
    solid += map.sfaces[map.shalfedges[e].sface].mark != 0 ? 1 : 0;
    e = map.next_around(e);
  } while (e != out);
  edges.are_simple = edges.are_simple && solid == 1;
  do {
    const std::uint32_t next = map.next_around(e);
    const PlaneId first = map.shalfedges[e].plane;
    const PlaneId last = map.shalfedges[next].plane;
    if (map.sfaces[map.shalfedges[e].sface].mark == 0 &&
        (next == e || orientation_around(c_.planes, along, first, last, monitor) < 0)) {
      edges.convex.push_back({vertex.index(), c_.target(halfedge).index(), line, first, last.opposite(), mark});
      return;
    }
    e = next;
  } while (e != out);
  ++edges.cells;
}

bool SolidFeatures::is_peak(std::uint32_t number, const PlaneNormal& up, const Monitor& monitor) const {
  const VertexId vertex{number};
  if (c_.vertices[vertex].svertices == c_.vertices[vertex.next()].svertices)
    return c_.sphere_map(vertex).trivial();  // a single point, or inside a facet
  for (const HalfedgeId h : c_.halfedges(vertex)) {
    const int along = h < c_.twin[h] ? 1 : -1;
    if (along * lines_.sign_of_dot(lines_.edge_of(h), up, monitor) >= 0) return false;
  }
  // The directions that all edges go down from are a convex cone, and none of them is on an arc that is shorter than a
  // half-turn, so all of them are in one sface.
  const std::atomic_ref<std::uint8_t> known(top_[number]);
  Top top{known.load(std::memory_order_relaxed)};
  if (top == Top::kFree || top == Top::kTaken) return top == Top::kFree;
  const SphereMapView map = c_.sphere_map(vertex);
  const bool is_free = mark_at(map, locate(c_.planes, map, up.direction(), monitor)) == 0;
  if (top == Top::kDepends) return is_free;
  top = has_long_arcs(map, monitor) ? Top::kDepends : is_free ? Top::kFree : Top::kTaken;
  known.store(static_cast<std::uint8_t>(top), std::memory_order_relaxed);
  return is_free;
}

bool SolidFeatures::touches(const ConvexEdge& edge, const PlaneNormal& normal, const Monitor& monitor) const {
  if (edge.is_bare) return true;
  const PlaneNormal first = this->normal(edge.first);
  const PlaneNormal last = this->normal(edge.last);
  // That the first normal comes before the second one about the edge.
  const auto in_order = [&](const PlaneNormal& u, const PlaneNormal& v) {
    const NearVector product = near_cross(u.near(), v.near());
    const int sure = kFastPaths ? sure_sign_of_dot(lines_.near(edge.line), product) : 0;
    if (sure != 0) return sure > 0;
    return sign_of_determinant(lines_.direction(edge.line), u.direction(), v.direction(), monitor) > 0;
  };
  return in_order(first, normal) && in_order(normal, last);
}

bool SolidFeatures::has_long_arcs(const SphereMapView& map, const Monitor& monitor) const {
  if (!map.sloops.empty()) return true;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const Direction from = direction_of(c_.planes, map.svertices[map.shalfedges[e].source]);
    const Direction to = direction_of(c_.planes, map.svertices[map.target(e)]);
    if (orientation_on_circle(c_.planes, map.shalfedges[e].plane, from, to, monitor) <= 0) return true;
  }
  return false;
}

}  // namespace nef::minkowski
