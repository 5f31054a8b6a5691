// SPDX-License-Identifier: Apache-2.0
//
// The union of many convex solids at once, without intermediate results: vertices of the union are points of boundaries
// that no solid has inside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// The union of convex cells of dimension 3, with their marks; nothing if it took more than `budget` evaluations of a
/// plane's form (a few nanoseconds each; counted, not timed: the same for every run), or the size of all is not between
/// 2^-200 and 2^200 (has_moderate_size). Facets inside of other cells, or of the union of facets in their plane, are
/// dropped by filters before anything exact exists, so the time goes with what is left: O(n log n + m k) for n faces, m
/// of them not hidden, each of which k others meet. Where many faces nearly coincide, m and k are n, and candidates are
/// their triples: that is what the budget is for. Adds the number of cells that lie inside of others to `dropped` if it
/// is given. Tells of kSumPhase by the faces that are left.
std::optional<Polyhedron> try_unite_solids(std::span<const ConvexCell> cells, std::uint64_t budget,
                                           std::size_t* dropped, const Monitor& monitor);

/// The same without a budget; of other sizes by unions of two.
Polyhedron unite_solids(std::span<const ConvexCell> cells, std::size_t* dropped = nullptr, const Monitor& monitor = {});

}  // namespace nef::minkowski
