// SPDX-License-Identifier: Apache-2.0
//
// The one unbounded sum in closed form.
#pragma once

#include <optional>

#include "nef/polyhedron.h"

namespace nef::minkowski {

/// H + B for a bounded set B, if `h` is a closed or open half-space; nothing if it is another set.
/// The sum is the half-space moved to where B reaches farthest; it is closed iff H is and B has a
/// point there. O(n).
std::optional<Polyhedron> halfspace_sum(const Polyhedron& h, const Polyhedron& b);

}  // namespace nef::minkowski
