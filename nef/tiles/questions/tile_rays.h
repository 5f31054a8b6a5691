// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "nef/tiles/tile_tree.h"

namespace nef {

/// What shoot_ray of nef/tiles/tiled_polyhedron.h says.
std::optional<RayHit> first_hit_in_tiles(const TileRef& tree, const Rational3& origin, const Rational3& direction,
                                         const std::function<bool(const Location&)>& accept, const Monitor& monitor);

}  // namespace nef
