// SPDX-License-Identifier: Apache-2.0
//
// The walls of the vertical decomposition ([Hachenberger 2009], after [de Berg, Guibas, Halperin 1996]).
//
// Walls stand along one axis (see reflex.h); say, z.
//
// First phase: the sight wall of a reflex edge is all points that can be seen from the edge along z
// before the boundary of the volume is met. It depends on no other wall, so there is no order of erection and
// there are no cyclic dependencies to resolve. Afterwards every vertical line meets a volume in one piece.
// Second phase: a wall in an upright plane leaves a vertical reflex edge and fills the volume's
// whole cut with that plane, up to where the volume's shadow on the xy-plane ends. ([Hachenberger 2009] takes
// planes x = const and two walls for most edges; prolonging a facet takes one.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/decomposition/plane_slice.h"
#include "apps/minkowski/decomposition/reflex.h"
#include "nef/complex/complex.h"
#include "nef/construct/construct.h"

namespace nef::minkowski {

/// Erects walls in one complex, which must not change and must outlive it.
class WallBuilder {
 public:
  WallBuilder(const Complex& complex, std::size_t axis, const Monitor& monitor);

  /// Appends the sight walls of a reflex edge that is not vertical, one or two faces, to a mesh.
  /// O(k^2) for k facets and edges over or under the edge.
  void erect(const ReflexEdge& edge, Mesh& walls);

  /// Appends a wall of a vertical reflex edge. O(k^2) for k facets of the volume.
  void erect(const ReflexEdge& edge, const CrossWall& wall, Mesh& walls);

  /// Appends both sight walls of a segment inside a volume that is not an edge.
  void erect(const Rational3& from, const Rational3& to, Mesh& walls);

 private:
  using FlatPoint = std::array<Rational, 2>;
  struct Run {
    std::uint32_t segment = 0;
    std::uint32_t first = 0, last = 0;  // breakpoints
  };

  void erect_sight_wall(const Rational3& from, const Rational3& to, bool upwards, Mesh& walls);
  [[nodiscard]] std::vector<Rational> breakpoints(const Rational& from, const Rational& to) const;
  [[nodiscard]] std::vector<Run> visible(const SliceSegment& base, const std::vector<Rational>& u, bool upwards) const;

  struct Gap {
    const SliceSegment* low = nullptr;
    const SliceSegment* high = nullptr;
  };
  void erect_cross_wall(const ReflexEdge& edge, PlaneId plane, int way, Mesh& walls);
  [[nodiscard]] std::vector<Rational> stops(const Rational& from, int way) const;
  [[nodiscard]] Gap find_gap(const Rational& from, const Rational& to, const Rational& low, const Rational& high) const;
  [[nodiscard]] bool blocked(const Rational& at, Rational low, const Rational& high) const;

  static void add_face(const SliceFrame& frame, const std::vector<FlatPoint>& ring, Mesh& walls);

  const Complex& complex_;
  std::size_t axis_;
  PlaneSlicer slicer_;
  IndexedVector<VolumeId, std::vector<FacetId>> facets_of_volume_;
};

}  // namespace nef::minkowski
