// SPDX-License-Identifier: Apache-2.0
//
// Which convex cells lie inside other ones: they can be left out of a union.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"

namespace nef::minkowski {

/// For each cell 1 if it certainly lies in another cell of the span that is not marked itself.
/// A filter in doubles with a proven bound: what it cannot decide counts as not held, so equal
/// cells stay. O(n^2) box tests at worst, then O(vertices * facets) a pair until a vertex sticks out.
std::vector<std::uint8_t> held_by_others(std::span<const ConvexCell> cells);

}  // namespace nef::minkowski
