// SPDX-License-Identifier: Apache-2.0
//
// Meshes moved to the origin, where floats are finest.
#pragma once

#include <span>

#include "nef/mesh/mesh.h"

namespace nef {

/// A point near the middle of the points' box, which has few digits: a multiple of the least power of two that is at
/// least the box's longest side, in each coordinate a double. The origin for no points, and in a coordinate whose
/// middle is beyond doubles. O(n).
Rational3 middle_of_few_digits(std::span<const Rational3> points);

/// Subtracts middle_of_few_digits from the vertices and returns it.
Rational3 recenter(Mesh& mesh);

}  // namespace nef
