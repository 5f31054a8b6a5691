// SPDX-License-Identifier: Apache-2.0
//
// What of a solid can touch another one without entering it, and in which directions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {

/// A facet of a solid.
struct SolidFacet {
  Direction normal;                                ///< outward
  std::vector<std::vector<std::uint32_t>> pieces;  ///< convex polygons, counterclockwise from outside, of vertices
};

/// An edge at which more than a half-turn is free. The normals of the planes that touch the solid there form an arc,
/// shorter than a half circle, from that of one facet to that of the other, counterclockwise about the edge.
struct ConvexEdge {
  std::uint32_t from = 0, to = 0;
  Direction line;  ///< from `from` to `to`
  Direction first, last;

  /// True if a direction that is normal to the edge lies in the inside of the arc.
  [[nodiscard]] bool touches(const Direction& normal) const;
};

/// Facets, convex edges and vertices of a bounded closed regular set.
class SolidFeatures {
 public:
  /// The solid must outlive the object. O(n), and for facets that are not convex what a triangulation takes.
  explicit SolidFeatures(const Polyhedron& solid);

  [[nodiscard]] const std::vector<SolidFacet>& facets() const { return facets_; }
  [[nodiscard]] const std::vector<ConvexEdge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<Rational3>& points() const { return points_; }

  /// True if the solid near the vertex lies below it in the direction: strictly, but for the vertex itself. O(degree).
  [[nodiscard]] bool is_peak(std::uint32_t vertex, const Direction& up) const;

 private:
  void add_facets();
  void add_edge(std::uint32_t vertex, std::uint32_t svertex);

  const Complex& c_;
  std::vector<Rational3> points_;
  std::vector<SolidFacet> facets_;
  std::vector<ConvexEdge> edges_;
  std::vector<Direction> directions_;  // of halfedges, away from their vertices
};

}  // namespace nef::minkowski
