// SPDX-License-Identifier: Apache-2.0
//
// The rectangles of charts side by side in one image.
#pragma once

#include "apps/visual_hull/texture/charts.h"

namespace nef::visual_hull {

/// Places all rectangles of an atlas side by side, with two texels of padding around each, in rows of falling heights.
/// An atlas larger than `largest` texels a side is scaled down. Throws InputError if there are too many charts even so.
/// O(n log n).
void pack(Atlas& atlas, int largest);

}  // namespace nef::visual_hull
