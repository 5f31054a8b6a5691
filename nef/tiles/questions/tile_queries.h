// SPDX-License-Identifier: Apache-2.0
//
// Questions that a tree of tiles answers without being glued.
#pragma once

#include <functional>
#include <optional>

#include "nef/tiles/tile_tree.h"

namespace nef {

/// Calls visit(leaf, region) for every leaf of a tree over all of space, uniform ones included, always in the same
/// order. Regions refer to planes of the tree.
void for_each_leaf(const TileRef& tree, const std::function<void(const TileRef& leaf, const Region& region)>& visit);

/// The volume of the set of a leaf in its region; nothing if it is infinite.
std::optional<Rational> volume_of_leaf(const TileRef& leaf, const Region& region);

/// The local pyramid of the whole set at a point, with planes of its own.
struct PyramidInTiles {
  PlaneTable planes;
  SphereMapBuffer map;

  /// The item of the whole set there; its index is 0.
  [[nodiscard]] Location location(const Monitor& monitor) const;
};
PyramidInTiles pyramid_in_tiles(const TileRef& tree, const Rational3& point, const Monitor& monitor);

/// What nef/tiles/tiled_polyhedron.h says of the function of this name.
Location locate_in_tiles(const TileRef& tree, const Rational3& point, const Monitor& monitor);

/// What is found out of tiles one by one.
struct ExtentOfTiles {
  std::optional<Rational> volume;  ///< nothing if it is infinite, or not asked for
  /// Smallest and largest coordinates of the vertices at which the set has boundary, those in walls included; nothing
  /// for none, or if it is not asked for.
  std::optional<std::array<Rational3, 2>> box;
  bool bounded = true;  ///< no such vertex lies at infinity; else `box` means nothing
};
/// Looks at each tile once, on the threads of `monitor`, each of which holds one at a time.
ExtentOfTiles extent_of_tiles(const TileRef& tree, bool with_volume, bool with_box, const Monitor& monitor);

}  // namespace nef
