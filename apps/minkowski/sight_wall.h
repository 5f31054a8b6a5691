// SPDX-License-Identifier: Apache-2.0
//
// Sight walls (thesis 10.2.2, after de Berg, Guibas and Halperin): all points that can be seen from
// an edge along an axis before the boundary of the volume is met. A wall depends on no other wall,
// so there is no order of erection and there are no cyclic dependencies to resolve.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/reflex.h"
#include "nef/complex/complex.h"
#include "nef/construct/construct.h"
#include "nef/geometry/box_tree.h"

namespace nef::minkowski {

/// Erects walls in one complex, which must not change and must outlive it.
class WallBuilder {
 public:
  explicit WallBuilder(const Complex& complex);

  /// Appends the walls of a reflex edge, one or two faces, to a mesh. Each is a polygon that is
  /// monotone along the edge. O(k^2) for k facets and edges over or under the edge.
  void erect(const ReflexEdge& edge, Mesh& walls);

  /// Appends both walls (along z) of a segment inside a volume that is not an edge of the complex.
  void erect(const Rational3& from, const Rational3& to, Mesh& walls);

 private:
  // A wall in the making, in its own plane: u runs along the edge, h along the axis.
  struct Base {
    Rational3 from, to;  // from[u] < to[u]
    std::size_t u = 0, h = 2;
    PlaneId plane;  // of wall_planes_
  };
  // What blocks the sight, from left to right.
  struct Blocker {
    std::array<Rational, 2> u, h;
    std::array<double, 2> du, dh;
  };
  struct Run {
    std::uint32_t blocker = 0;
    std::uint32_t first = 0, last = 0;  // breakpoints
  };

  void erect(const Base& base, bool upwards, Mesh& walls);
  Base base_of(const Rational3& from, const Rational3& to, std::size_t axis);
  void collect(const Base& base, bool upwards);
  void collect_facet(const Base& base, std::uint32_t facet);
  void collect_isolated_edge(const Base& base, std::uint32_t halfedge);
  void add_blocker(const std::array<Rational, 2>& p, const std::array<Rational, 2>& q);
  int side(const Base& base, std::uint32_t vertex);
  const Rational3& point(std::uint32_t vertex);
  std::array<Rational, 2> crossing(const Base& base, std::uint32_t a, std::uint32_t b);
  [[nodiscard]] bool holds(std::uint32_t facet, const Base& base, const std::array<Rational, 2>& p);
  std::vector<Rational> breakpoints(const Base& base) const;
  std::vector<Run> visible(const Base& base, const std::vector<Rational>& u, bool upwards) const;

  const Complex& complex_;
  PlaneTable wall_planes_;
  std::vector<Box> facet_boxes_;
  BoxTree facets_;
  std::vector<std::uint8_t> convex_;           // per facet: has no reflex corner
  std::vector<std::uint32_t> isolated_edges_;  // halfedges without facets
  std::vector<Rational3> points_;
  std::vector<std::uint8_t> known_;
  std::vector<std::uint32_t> side_wall_;  // per vertex: the wall that side_of_ belongs to
  std::vector<std::int8_t> side_of_;
  std::uint32_t wall_ = 0;
  std::vector<Blocker> blockers_;
};

}  // namespace nef::minkowski
