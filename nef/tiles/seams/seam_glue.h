// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/tiles/tile_tree.h"

namespace nef {

/// The set of a tree in its region as one complex. What lies inside of tiles is copied; at every point of a seam where
/// a vertex may be, the local pyramids in the tiles around it are put together, and all is linked once. O(n log n).
/// Expected: n vertices of which those in seams that are none of cut edges cost an overlay on the sphere each.
Polyhedron glue_tiles(const TileRef& tree, const Region& region, const Monitor& monitor);

/// The same for all of space, in canonical order (nef/operation/canonical_order.h), on the threads of `monitor`.
/// Links inside of tiles are kept.
Polyhedron glue_all_tiles(const TileRef& tree, const Monitor& monitor);

}  // namespace nef
