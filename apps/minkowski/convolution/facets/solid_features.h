// SPDX-License-Identifier: Apache-2.0
//
// What of a solid, or of a sheet or curve, can touch a solid without entering it, and in which directions.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "apps/minkowski/convolution/facets/feature_directions.h"
#include "nef/complex/complex.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// A convex polygon, or a segment as a ring of two, with the marks of what it consists of.
struct FacetPiece {
  std::vector<std::uint32_t> ring;  ///< vertices, counterclockwise from outside; some may be straight
  std::vector<std::uint8_t> sides;  ///< marks; side i runs from vertex i to the next one
  std::uint8_t mark = 1;            ///< of the inside
};

/// A facet of a solid. One of a sheet is two such facets.
struct SolidFacet {
  PlaneId plane;  ///< positive outside
  std::vector<FacetPiece> pieces;
  /// Vertices around a facet of several pieces, which has them on its left as seen from outside; the outer ring first.
  /// None if there is just one piece, or an edge ends inside of the facet.
  std::vector<std::vector<std::uint32_t>> rings;
};

/// An edge at which more than a half-turn is free. The normals of the planes that touch the set there form an arc, from
/// that of one facet to that of the other, counterclockwise about the edge: shorter than a half circle, or that at the
/// border of a sheet. At an edge of a curve it is all of the circle.
struct ConvexEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t line = 0;  ///< from `from` to `to`: its number in SolidFeatures::lines()
  PlaneId first, last;     ///< positive outside
  std::uint8_t mark = 1;
  bool is_bare = false;  ///< no facets; first and last mean nothing
};

/// Which points of a boundary belong to the set.
enum class BoundaryMarks : std::uint8_t { kAll, kNone, kMixed };

/// Facets, convex edges and vertices of a bounded set all of whose facets have the inside of the set on one side and
/// nothing of it on the other; or of any closed bounded set. May be shared between threads.
class SolidFeatures {
 public:
  /// The solid must outlive the object. O(n), and for facets that are not convex what a triangulation takes.
  SolidFeatures(const Polyhedron& solid, const Monitor& monitor);

  [[nodiscard]] BoundaryMarks marks() const { return marks_; }
  [[nodiscard]] std::uint8_t mark(std::uint32_t vertex) const { return c_.mark(VertexId{vertex}) != 0 ? 1 : 0; }
  /// True if the solid fills one wedge around every edge.
  [[nodiscard]] bool has_simple_edges() const { return has_simple_edges_; }
  /// About how many convex cells the set consists of: solids, one more for each edge that has no more than a half-turn
  /// free, and what is no solid.
  [[nodiscard]] std::size_t cells() const { return cells_; }
  /// True if no facet has a single point inside that is marked unlike it.
  [[nodiscard]] bool has_plain_facets() const { return has_plain_facets_; }

  [[nodiscard]] const std::vector<SolidFacet>& facets() const { return facets_; }
  [[nodiscard]] const std::vector<ConvexEdge>& edges() const { return edges_; }
  /// The lines of all edges of the set.
  [[nodiscard]] const EdgeLines& lines() const { return lines_; }
  [[nodiscard]] PlaneNormal normal(PlaneId plane) const { return {c_.planes, plane}; }
  [[nodiscard]] const std::vector<Rational3>& points() const { return points_; }

  /// True if the set near the vertex lies below it in the direction: strictly, but for the vertex itself. O(degree).
  [[nodiscard]] bool is_peak(std::uint32_t vertex, const PlaneNormal& up, const Monitor& monitor) const;

  /// True if a normal that is square to an edge lies in the inside of the edge's arc.
  [[nodiscard]] bool touches(const ConvexEdge& edge, const PlaneNormal& normal, const Monitor& monitor) const;

 private:
  /// What comes of some edges.
  struct Edges {
    std::vector<ConvexEdge> convex;
    std::size_t cells = 0;
    bool are_simple = true;
  };

  void find_marks();
  void count_cells();
  void find_facets(const Monitor& monitor);
  void find_edges(const Monitor& monitor);
  [[nodiscard]] SolidFacet facet_of(const Facet& facet, bool solid_above,
                                    const std::vector<std::vector<std::uint32_t>>& pieces,
                                    const std::vector<std::vector<std::uint32_t>>& rings) const;
  void mark_sides(FacetPiece& piece) const;
  void add_edge(VertexId vertex, std::uint32_t svertex, Edges& edges, const Monitor& monitor) const;
  /// What is above a vertex all of whose edges go down.
  enum class Top : std::uint8_t { kUnknown, kFree, kTaken, kDepends };
  [[nodiscard]] bool has_long_arcs(const SphereMapView& map, const Monitor& monitor) const;

  const Complex& c_;
  std::vector<Rational3> points_;
  std::vector<SolidFacet> facets_;
  std::vector<ConvexEdge> edges_;
  EdgeLines lines_;
  std::unordered_map<std::uint64_t, std::uint8_t> edge_marks_;  // by the key of the ends, if marks are mixed
  mutable std::vector<std::uint8_t> top_;                       // per vertex, a Top; several threads may find it
  BoundaryMarks marks_ = BoundaryMarks::kAll;
  std::size_t cells_ = 0;
  bool has_simple_edges_ = true;
  bool has_plain_facets_ = true;
};

}  // namespace nef::minkowski
