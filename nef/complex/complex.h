// SPDX-License-Identifier: Apache-2.0
//
// The selective Nef complex (thesis chapter 4): vertices with their sphere maps, and what synthesis
// adds to them: edges, facets, shells and volumes. Flat arrays and 32-bit indices; a complex never
// changes once it is synthesized, so it may be read from any number of threads.
//
// Conventions:
//  - vertex v lies at point v of `points` (point_of(v)); its sphere map is a pattern, which many vertices share, and
//  the planes of
//    its items; svertices, shalfedges, sloops and sfaces are numbered vertex after vertex, and have local indices
//    inside their sphere map (see nef/sphere_map/sphere_map.h);
//  - an svertex of the whole complex is a halfedge; `twin` pairs them into edges;
//  - halffacet 2f is facet f seen from the positive side of its (unflipped) plane, 2f+1 from the
//    other side; the volume incident to a halffacet lies on the side it is seen from;
//  - a corner is the shalfedge of a facet at a boundary vertex, oriented like halffacet 2f. The
//    corners of a cycle are in boundary order with the facet to the left: from a corner the
//    boundary goes on along the halfedge of the corner's source svertex;
//  - volume 0 is the outer volume. In a complex with an infimaximal box its mark is kOutside.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/ids.h"
#include "nef/complex/patterns/pair_columns.h"
#include "nef/complex/patterns/pattern_table.h"
#include "nef/complex/tables/facet_table.h"
#include "nef/complex/tables/vertex_table.h"
#include "nef/geometry/point_table.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// A connected component of the boundary of a volume; the sfaces that touch it know it (see shell_sfaces.h).
struct Shell {
  VolumeId volume{0};
};

/// A connected open region of space with one mark.
struct Volume {
  LabelId mark = 0;
  ShellId first_shell{0};  ///< the outer shell (none for the outer volume); the others follow
  std::uint32_t shell_count = 0;

  /// The outer shell first.
  [[nodiscard]] IdRange<ShellId> shells() const { return {first_shell, shell_count}; }
};

struct Complex {
  PlaneTable planes;
  PointTable points;

  VertexTable vertices;  ///< one more than there are vertices

  PatternTable patterns;  ///< each is that of a vertex
  PlaneColumn shalfedge_plane;
  std::vector<PlaneId> other_planes;  ///< that svertices name and no shalfedge of the vertex has
  std::vector<SLoop> sloops;

  // Added by synthesis, parallel to the arrays above.
  IndexedVector<HalfedgeId, VertexId> svertex_owner;
  IndexedVector<HalfedgeId, HalfedgeId> twin;  ///< at the other end of the edge
  std::vector<VertexId> pair_owner;            ///< vertex of each pair of shalfedges; empty: svertex_owner says it
  HalffacetColumn shalfedge_facet;
  std::vector<HalffacetId> sloop_facet;
  IndexedVector<SFaceId, ShellId> sface_shell;

  FacetTable facets;
  IndexedVector<CycleId, std::uint32_t> cycle_begin{0};  ///< into corners; one more than there are cycles
  std::vector<SHalfedgeId> corners;
  std::vector<VertexId> isolated_vertices;

  IndexedVector<ShellId, Shell> shells;
  IndexedVector<VolumeId, Volume> volumes;
  LabelId label_count = 2;  ///< every mark but kOutside is below it; at least 2

  [[nodiscard]] std::size_t vertex_count() const { return vertices.size() - 1; }
  [[nodiscard]] std::size_t edge_count() const { return svertex_count() / 2; }
  [[nodiscard]] std::size_t facet_count() const { return facets.size(); }
  [[nodiscard]] std::size_t volume_count() const { return volumes.size(); }
  [[nodiscard]] std::uint32_t svertex_count() const { return vertices.back().svertices.index(); }
  [[nodiscard]] std::uint32_t shalfedge_count() const { return vertices.back().shalfedges.index(); }
  [[nodiscard]] std::uint32_t sface_count() const { return vertices.back().sfaces.index(); }

  [[nodiscard]] IdRange<VertexId> vertex_ids() const {
    return {VertexId{0}, static_cast<std::uint32_t>(vertices.size() - 1)};
  }
  [[nodiscard]] IdRange<HalfedgeId> halfedge_ids() const { return {HalfedgeId{0}, vertices.back().svertices}; }
  [[nodiscard]] IdRange<SHalfedgeId> shalfedge_ids() const { return {SHalfedgeId{0}, vertices.back().shalfedges}; }
  [[nodiscard]] IdRange<SFaceId> sface_ids() const { return {SFaceId{0}, vertices.back().sfaces}; }
  [[nodiscard]] IdRange<CycleId> cycle_ids() const {
    return {CycleId{0}, static_cast<std::uint32_t>(cycle_begin.size() - 1)};
  }

  /// True if the set is unbounded in a way that needed an infimaximal box.
  [[nodiscard]] bool has_box() const { return !volumes.empty() && volumes[kOuterVolume].mark == kOutside; }

  /// The halfedges that leave a vertex; the first is svertex 0 of its sphere map.
  [[nodiscard]] IdRange<HalfedgeId> halfedges(VertexId vertex) const {
    return {vertices.svertices(vertex), vertices.svertices(vertex.next())};
  }

  /// The shalfedges around a vertex, likewise.
  [[nodiscard]] IdRange<SHalfedgeId> shalfedges(VertexId vertex) const {
    return {vertices.shalfedges(vertex), vertices.shalfedges(vertex.next())};
  }

  /// The sfaces around a vertex, likewise.
  [[nodiscard]] IdRange<SFaceId> sfaces(VertexId vertex) const {
    return {vertices.sfaces(vertex), vertices.sfaces(vertex.next())};
  }

  /// The planes of the even shalfedges of a vertex.
  [[nodiscard]] std::span<const PlaneId> planes_of_pairs(VertexId vertex) const {
    const std::uint32_t first = pair_of(vertices.shalfedges(vertex));
    return std::span(shalfedge_plane.pairs()).subspan(first, pair_of(vertices.shalfedges(vertex.next())) - first);
  }

  /// The sphere map of a vertex.
  [[nodiscard]] SphereMapView sphere_map(VertexId vertex) const {
    const VertexRecord record = vertices[vertex];
    const LocalPlanes named = local_planes(vertex);
    return {{patterns.svertices(record.pattern), named},
            {patterns.shalfedges(record.pattern), named},
            {sloops.data() + record.sloops, vertices[vertex.next()].sloops - record.sloops},
            patterns.sfaces(record.pattern),
            patterns.entries(record.pattern),
            patterns.mark(record.pattern)};
  }

  [[nodiscard]] LabelId mark(VertexId vertex) const { return patterns.mark(vertices.pattern(vertex)); }

  /// A halfedge as the svertex that it is in the sphere map of its source. Needs svertex_owner.
  [[nodiscard]] SVertex svertex(HalfedgeId halfedge) const {
    const VertexId vertex = svertex_owner[halfedge];
    return with_planes(patterns.svertex(vertices.pattern(vertex), halfedge - vertices.svertices(vertex)),
                       local_planes(vertex));
  }

  /// True if no facet touches the edge at this end of it. Needs svertex_owner.
  [[nodiscard]] bool is_bare(HalfedgeId halfedge) const {
    const VertexId vertex = svertex_owner[halfedge];
    return patterns.svertex(vertices.pattern(vertex), halfedge - vertices.svertices(vertex)).out == kNone;
  }

  /// A shalfedge as the item that it is in the sphere map of its vertex. Needs the owners.
  [[nodiscard]] SHalfedge shalfedge(SHalfedgeId shalfedge) const {
    SHalfedge item = in_pattern(shalfedge);
    item.plane = shalfedge_plane[shalfedge];
    return item;
  }

  /// The vertex of a shalfedge. Where every svertex has two arcs, as in all sets whose boundary is a manifold, a vertex
  /// has as many svertices as pairs of shalfedges, and one list of owners serves both.
  [[nodiscard]] VertexId shalfedge_vertex(SHalfedgeId shalfedge) const {
    return pair_owner.empty() ? svertex_owner[HalfedgeId{pair_of(shalfedge)}] : pair_owner[pair_of(shalfedge)];
  }

  /// The mark of an sface. O(log n).
  [[nodiscard]] LabelId sface_mark(SFaceId sface) const {
    const VertexId vertex = sface_vertex(sface);
    return patterns.sfaces(vertices.pattern(vertex))[sface - vertices.sfaces(vertex)].mark;
  }

  /// The vertex that a halfedge leaves, and the one at its other end.
  [[nodiscard]] VertexId source(HalfedgeId halfedge) const { return svertex_owner[halfedge]; }
  [[nodiscard]] VertexId target(HalfedgeId halfedge) const { return svertex_owner[twin[halfedge]]; }

  /// The edges that no facet touches, each by its smaller halfedge, ascending. O(vertices).
  [[nodiscard]] std::vector<HalfedgeId> bare_edges() const;

  /// The smaller halfedge of an edge, where one is to stand for both.
  [[nodiscard]] HalfedgeId edge(HalfedgeId halfedge) const { return std::min(halfedge, twin[halfedge]); }

  /// The halfedge that leaves the vertex of a corner along the facet boundary (facet to its left).
  [[nodiscard]] HalfedgeId corner_halfedge(SHalfedgeId corner) const {
    return vertices.svertices(shalfedge_vertex(corner)) + in_pattern(corner).source;
  }
  /// The halfedge at the vertex of a corner that leads back along the facet boundary.
  [[nodiscard]] HalfedgeId corner_back_halfedge(SHalfedgeId corner) const {
    return vertices.svertices(shalfedge_vertex(corner)) + in_pattern(twin_of(corner)).source;
  }
  /// The sfaces on both sides of a shalfedge: to its left and to its right.
  [[nodiscard]] std::array<SFaceId, 2> shalfedge_sfaces(SHalfedgeId shalfedge) const {
    const VertexId vertex = shalfedge_vertex(shalfedge);
    const PatternId pattern = vertices.pattern(vertex);
    const std::uint32_t local = shalfedge - vertices.shalfedges(vertex);
    const SFaceId first = vertices.sfaces(vertex);
    return {first + patterns.shalfedge(pattern, local).sface, first + patterns.shalfedge(pattern, local ^ 1U).sface};
  }
  /// The sface to the left of a shalfedge.
  [[nodiscard]] SFaceId shalfedge_sface(SHalfedgeId shalfedge) const {
    return vertices.sfaces(shalfedge_vertex(shalfedge)) + in_pattern(shalfedge).sface;
  }
  [[nodiscard]] VolumeId sface_volume(SFaceId sface) const { return shells[sface_shell[sface]].volume; }

  /// The volume on the side from which a halffacet is seen.
  [[nodiscard]] VolumeId halffacet_volume(HalffacetId halffacet) const {
    const FacetSides sides = facets.sides_of(facet_of(halffacet));
    return is_below(halffacet) ? sides.volume_below : sides.volume_above;
  }

  /// The corners of a cycle.
  [[nodiscard]] std::span<const SHalfedgeId> corners_of(CycleId cycle) const {
    return {corners.data() + cycle_begin[cycle], cycle_begin[cycle.next()] - cycle_begin[cycle]};
  }
  /// All corners of a facet, cycle after cycle.
  [[nodiscard]] std::span<const SHalfedgeId> corners_of(const Facet& facet) const {
    const std::uint32_t first = cycle_begin[facet.first_cycle];
    return {corners.data() + first, cycle_begin[facet.cycles().end_id()] - first};
  }
  [[nodiscard]] std::span<const SHalfedgeId> corners_of(FacetId facet) const { return corners_of(facets[facet]); }

  /// The vertices inside a facet.
  [[nodiscard]] std::span<const VertexId> isolated_vertices_of(const Facet& facet) const {
    return {isolated_vertices.data() + facet.first_isolated, facet.isolated_count};
  }

  /// The vertex that an sface belongs to. O(log n).
  [[nodiscard]] VertexId sface_vertex(SFaceId sface) const;

  /// Gives memory back that has been reserved and not used, where that is an eighth of an array or more.
  void trim();

  /// Bytes held, GMP limbs included.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] LocalPlanes local_planes(VertexId vertex) const {
    const std::uint32_t pairs = pair_of(vertices.shalfedges(vertex));
    return {shalfedge_plane.pairs().data() + pairs, pair_of(vertices.shalfedges(vertex.next())) - pairs,
            other_planes.data() + vertices.other_planes(vertex)};
  }

  // Its plane is but a name.
  [[nodiscard]] const SHalfedge& in_pattern(SHalfedgeId shalfedge) const {
    const VertexId vertex = shalfedge_vertex(shalfedge);
    return patterns.shalfedge(vertices.pattern(vertex), shalfedge - vertices.shalfedges(vertex));
  }
};

/// Writes into all facets what is on them and on both sides of them, as their first corners tell it; where shells and
/// volumes are known. O(facets).
void name_sides_of_facets(Complex& complex, const Monitor& monitor);

/// Calls change(plane) for the planes that sphere maps of a complex name, those of twins once. Of a complex that is not
/// const, planes may be changed; then opposite planes must become opposite planes.
template <typename AnyComplex, typename Change>
void for_each_plane_of(AnyComplex& complex, Change&& change) {
  for (auto& plane : complex.shalfedge_plane.pairs()) change(plane);
  for (auto& plane : complex.other_planes) change(plane);
  for (auto& loop : complex.sloops) change(loop.plane);
}

}  // namespace nef
