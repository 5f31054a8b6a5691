// SPDX-License-Identifier: Apache-2.0
//
// Cutting a complex along axis-parallel planes, both halves in one pass.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/overlay.h"
#include "nef/tiles/tile_tree.h"
#include "nef/tiles/tiling.h"

namespace nef {

/// Cuts complexes until they are small. In between they are loose: without facets and volumes, which no cut needs,
/// their planes in one table, that of the cutter. Marks are below kMarks; only sets, of marks 0 and 1, become leaves.
class Cutter {
 public:
  static constexpr LabelId kMarks = 3;  ///< those of oriented surfaces

  /// A tile of more vertices than the limit is cut further.
  Cutter(PlaneTable planes, const Tiling& tiling, const Monitor& monitor)
      : planes_(std::move(planes)), tiling_(tiling), monitor_(monitor) {}

  [[nodiscard]] const PlaneTable& planes() const { return planes_; }

  /// The loose copy of a complex that has the cutter's planes, with an infimaximal box if it has none.
  Complex loose(const Complex& complex);

  /// The parts of a loose complex below and above a plane through its region. O(n), but for the local pyramids on the
  /// plane.
  std::array<Complex, 2> cut(const Complex& piece, const AxisPlane& plane);

  /// The part of a loose complex in a region.
  Complex restricted(Complex&& piece, const Region& region);

  /// A loose complex cut in the middle, if it is larger than the limit and planes can separate its vertices.
  struct Halved {
    AxisPlane plane;
    std::array<Complex, 2> halves;
  };
  std::optional<Halved> halve(const Complex& piece);

  /// A loose complex as a tree of tiles.
  TileRef subdivide(Complex&& piece);

  /// A loose complex with the planes that it uses, facets and volumes.
  Complex linked(Complex&& piece);

  /// A loose complex as one leaf, which may be marked as uncut (TileNode).
  TileRef leaf(Complex&& piece, bool uncut = false);

 private:
  class Halves;

  PlaneTable planes_;
  const Tiling& tiling_;
  Monitor monitor_;
  SphereOverlay overlay_;
  std::vector<std::uint32_t> row_;  // scratch of linked()
};

/// A set in its region as a tree of tiles of at most tiling.limit vertices, where planes can separate them, on the
/// threads of `monitor`. O(n log n).
TileRef subdivided(const Polyhedron& set, const Tiling& tiling, const Monitor& monitor);

/// What a set in all of space has in a region, as a tree of tiles like that of subdivided(). O(n log n).
TileRef tiles_in_region(const Polyhedron& set, const Region& region, const Tiling& tiling, const Monitor& monitor);

/// A tree with its uncut leaves cut as subdivided() does.
TileRef fully_cut(const TileRef& tree, const Tiling& tiling, const Monitor& monitor);

/// The parts of a leaf that is no uniform one on both sides of a plane through its region.
std::array<TileRef, 2> cut_leaf(const TileRef& leaf, const AxisPlane& plane, const Tiling& tiling,
                                const Monitor& monitor);

}  // namespace nef
