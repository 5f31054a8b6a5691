// SPDX-License-Identifier: Apache-2.0
//
// A convex polytope of any dimension with a mark on each face of its boundary: what the vertical
// decomposition yields, what convex sums are made of, and what a union takes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// A convex set between a relatively open polytope and its closure. The relative interior always
/// belongs to it; each proper face (facet, edge, vertex) belongs to it whole (its relative
/// interior) or not at all, and an edge or vertex belongs only if every larger face around it does.
struct ConvexCell {
  /// Which faces of the boundary belong to the cell.
  enum class Boundary : std::uint8_t { kClosed, kOpen, kMixed };

  /// 3: `mesh` is the closed surface, planar faces counterclockwise from outside, no two coplanar.
  /// 2: `mesh` has one face. 1: two vertices and no face. 0: one vertex and no face.
  int dimension = 0;
  Mesh mesh;
  Boundary boundary = Boundary::kClosed;
  /// Outward normals of the faces, of any length, if whoever made the cell had them (dimension 3 only); or none.
  std::vector<Integer3> normals;

  // Only for kMixed; empty otherwise.
  std::vector<std::uint8_t> facet_marks;   ///< per face of the mesh (dimension 3 only)
  std::vector<std::uint8_t> edge_marks;    ///< per corner: the edge to the next corner (dimension 2 and 3)
  std::vector<std::uint8_t> vertex_marks;  ///< per vertex (not for dimension 0)

  [[nodiscard]] bool facet_marked(std::size_t face) const {
    return boundary == Boundary::kMixed ? facet_marks[face] != 0 : boundary == Boundary::kClosed;
  }
  [[nodiscard]] bool edge_marked(std::size_t corner) const {
    return boundary == Boundary::kMixed ? edge_marks[corner] != 0 : boundary == Boundary::kClosed;
  }
  [[nodiscard]] bool vertex_marked(std::size_t vertex) const {
    return boundary == Boundary::kMixed ? vertex_marks[vertex] != 0 : boundary == Boundary::kClosed;
  }
};

/// The cell as a point set. O(n).
Polyhedron to_polyhedron(const ConvexCell& cell, const Monitor& monitor = {});

/// The closed convex hull of some points (at least one) as a cell. O(n log n) expected.
ConvexCell hull_cell(std::span<const Rational3> points, const Monitor& monitor = {});

/// c + d for convex cells with their marks: a face of the sum belongs to it iff the two faces that
/// it is the sum of do [Hachenberger 2006, 10.2.1]. Operands of any dimension. For two solids the overlay of
/// the normal diagrams is walked, O((n + m + k) log(n + m)) for k facets of the sum and vertices
/// of bounded degree; if one is flat, the hull of all sums of vertices is taken.
ConvexCell convex_sum(const ConvexCell& c, const ConvexCell& d, const Monitor& monitor = {});

/// The cell of the points -x. O(n).
ConvexCell negated(const ConvexCell& cell);

/// The cell moved. O(n).
ConvexCell translated(const ConvexCell& cell, const Rational3& by);

/// The interior of a cell relative to its own dimension.
ConvexCell opened(ConvexCell cell);

}  // namespace nef::minkowski
