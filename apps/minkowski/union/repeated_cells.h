// SPDX-License-Identifier: Apache-2.0
//
// Equal cells: A + A has every sum of two cells twice.
#pragma once

#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"

namespace nef::minkowski {

/// For each cell whether an equal one (the same vertices, both closed or both open) stands before it. O(n) expected.
std::vector<bool> repeated_cells(std::span<const ConvexCell> cells, const RoundedCells& rounded);

}  // namespace nef::minkowski
