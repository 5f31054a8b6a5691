// SPDX-License-Identifier: Apache-2.0
//
// Sums of convex cells of which one at least is not solid.
#pragma once

#include "apps/minkowski/convex/convex_cell.h"

namespace nef::minkowski {

/// The sum of cells of any dimensions by the hull of all sums of their vertices. O(n m log(n m)) expected.
ConvexCell flat_sum(const ConvexCell& c, const ConvexCell& d, const Monitor& monitor);

}  // namespace nef::minkowski
