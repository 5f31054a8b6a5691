// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nef/complex/complex.h"

namespace nef {

/// The coordinates of all vertices with a number in place of the infimaximal R that is greater
/// than anything the coordinates of the complex could be compared with. For checks, not for speed.
IndexedVector<VertexId, Rational3> concrete_points(const Complex& complex);

/// How often a closed polygon winds around a point of its plane, both projected along `axis`
/// (counterclockwise in the order of the two other axes counts +1).
struct Winding {
  int number = 0;
  bool on_boundary = false;
};
Winding winding_number(const std::vector<const Rational3*>& polygon, const Rational3& point, std::size_t axis);

/// The corners of cycle `cycle` as points.
std::vector<const Rational3*> cycle_points(const Complex& complex, const IndexedVector<VertexId, Rational3>& points,
                                           CycleId cycle);

}  // namespace nef
