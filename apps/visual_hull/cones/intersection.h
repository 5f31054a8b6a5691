// SPDX-License-Identifier: Apache-2.0
//
// The intersection of many cones.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/cones/cone.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {

/// One operand of the intersection: what a view keeps.
struct Part {
  nef::Polyhedron solid;
  Rational3 axis;  ///< the direction in which the view looks, for the order of work only
};

/// The closed set of points that all parts keep. The answer does not depend on the order of the
/// parts. Pairs of views that look in different directions meet first: their intersections are
/// small. Pairs are worked on by the threads of `monitor`, which
/// is told the number of intersections done and their total.
nef::Polyhedron intersect_parts(std::vector<Part> parts, const nef::Monitor& monitor = {});

/// The first part at which the intersection of all up to it, in the order given and within `box`,
/// is empty, or, with `solid`, has no interior any more. Nothing if that never happens.
std::optional<std::size_t> vanishes_at(const std::vector<Part>& parts, const nef::Polyhedron& box, bool solid,
                                       const nef::Monitor& monitor);

}  // namespace nef::visual_hull
