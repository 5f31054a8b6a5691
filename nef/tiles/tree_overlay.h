// SPDX-License-Identifier: Apache-2.0
//
// Boolean operations on trees of tiles.
#pragma once

#include <array>

#include "nef/tiles/tile_tree.h"
#include "nef/tiles/tiling.h"

namespace nef {

/// A Boolean function as a truth table: entry 2 * (in a) + (in b).
using TruthTable = std::array<bool, 4>;

/// The set f(a, b), both being sets in all of space. Tiles of `a` that the boundary of `b` does not enter are taken
/// over, or taken over as complements. O(1) for each node on the way to the others, and a Boolean operation for each of
/// them.
TileRef overlay_trees(const TileRef& a, const TileRef& b, const TruthTable& f, const Tiling& tiling,
                      const Monitor& monitor);

/// The parts of a tree on both sides of a plane through its region.
std::array<TileRef, 2> cut_tree(const TileRef& tree, const AxisPlane& plane, const Tiling& tiling,
                                const Monitor& monitor);

}  // namespace nef
