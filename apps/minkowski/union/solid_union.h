// SPDX-License-Identifier: Apache-2.0
//
// The union of many convex solids at once, without intermediate results: vertices of the union are points of boundaries
// that no solid has inside.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// The union of convex cells of dimension 3, with their marks. Facets inside of other cells are
/// dropped by filters before anything exact exists, so the time goes with what is left: O(n log n + m k)
/// for n faces, m of them not inside of a single cell, each of which k others meet.
/// Adds the number of cells that lie inside of others to `dropped` if it is given. Filters run on up to `threads`
/// threads (0: as many as the machine has); the result does not depend on their number. `poll`, if given, is called
/// for each face that is left, and may throw.
Polyhedron unite_solids(std::span<const ConvexCell> cells, std::size_t* dropped = nullptr, unsigned threads = 1,
                        const std::function<void()>& poll = {});

}  // namespace nef::minkowski
