// SPDX-License-Identifier: Apache-2.0
//
// Questions that a tree of tiles answers without being glued.
#pragma once

#include "nef/tiles/tile_tree.h"

namespace nef {

/// The local pyramid of the whole set at a point, with planes of its own.
struct PyramidInTiles {
  PlaneTable planes;
  SphereMapBuffer map;

  /// The item of the whole set there; its index is 0.
  [[nodiscard]] Location location() const;
};
PyramidInTiles pyramid_in_tiles(const TileRef& tree, const Rational3& point);

/// What nef/tiles/tiled_polyhedron.h says of the functions of these names.
Location locate_in_tiles(const TileRef& tree, const Rational3& point);
std::optional<Rational> volume_of_tiles(const TileRef& tree);

/// Smallest and largest coordinates of the vertices at which the set has boundary, those in walls included; nothing for
/// none. `bounded` becomes false if any lies at infinity: then it means nothing.
std::optional<std::array<Rational3, 2>> bounds_of_tiles(const TileRef& tree, bool& bounded);

}  // namespace nef
