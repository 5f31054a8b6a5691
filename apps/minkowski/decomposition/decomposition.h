// SPDX-License-Identifier: Apache-2.0
//
// Parts of the decomposition that sums need and users do not.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// decompose() with walls along a given axis, 0 to 2.
std::vector<ConvexCell> decompose_along(const Polyhedron& a, std::size_t axis, const Monitor& monitor);

/// The cells of dimension 3 of the decomposition, all open.
std::vector<ConvexCell> decompose_open(const Polyhedron& a, const Monitor& monitor);

/// True if the set lies in the closure of its interior: no antennas, fins or single points. O(n).
bool is_full_dimensional(const Polyhedron& a);

/// True for exactly one point. O(1).
bool is_point(const Polyhedron& a);

/// Throws UnsupportedError unless the set is bounded.
void require_bounded(const Polyhedron& a, const char* what);

}  // namespace nef::minkowski
