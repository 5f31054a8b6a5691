// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "apps/minkowski/convex/spanned_set.h"
#include "apps/minkowski/minkowski.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// A + B for any two sets, bounded or not, neither of them empty. Both are cut into convex cells by whole planes, one
/// through each reflex edge, so this is for sets with few of these: k planes make O(k^3) cells, and all pairs
/// of cells are summed. Throws UnsupportedError for more than a few dozen planes or some ten thousand pairs.
Polyhedron unbounded_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                         MinkowskiReport& report);

/// What spans the closed convex hull of an unbounded set whose complement is unbounded, too. O(n).
SpannedSet hull_span(const Polyhedron& a);

}  // namespace nef::minkowski
