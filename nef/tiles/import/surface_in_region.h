// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "nef/mesh/mesh.h"
#include "nef/tiles/tile_tree.h"
#include "nef/tiles/tiling.h"

namespace nef {

/// The part of a closed solid in a region, from the planar or triangular faces that meet the region, which may meet in
/// common vertices and edges only; what they are like beyond the region does not matter. `inside` tells whether the
/// interior of the region is in the solid; it is asked if no face divides it. Nothing if the faces do not separate
/// inside from outside. O(n log n).
std::optional<TileRef> solid_in_region(const Mesh& faces, const Region& region, const Tiling& tiling,
                                       const Monitor& monitor, const std::function<bool()>& inside);

}  // namespace nef
