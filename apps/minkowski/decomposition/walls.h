// SPDX-License-Identifier: Apache-2.0
//
// The two phases of the vertical decomposition, and cuts of facets, as overlays: walls and cuts
// are lower-dimensional Nef sets, and inserting all of them is one operation each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nef/base/monitor.h"
#include "nef/complex/ids.h"
#include "nef/forward.h"

namespace nef::minkowski {

// Labels of a decomposed set. Bit 0: the point is in the set; the others tell its parts apart.
inline constexpr LabelId kSelected = 1;
inline constexpr LabelId kWall = 2;
inline constexpr LabelId kCut = 4;

/// The bounded set with walls inserted so that each selected volume is convex. Marks are labels as
/// above. First walls along the axis (0 to 2) for every reflex edge that is not parallel to it (which leaves volumes
/// that each line along it meets in one piece), then upright walls for the vertical reflex edges that
/// are left or were made. A set without reflex edges is returned as it is.
Polyhedron erect_walls(const Polyhedron& a, std::size_t axis, const Monitor& monitor);

/// The same set with cuts in the given facets, so that they become convex.
Polyhedron cut_facets(const Polyhedron& a, std::span<const FacetId> facets, const Monitor& monitor);

}  // namespace nef::minkowski
