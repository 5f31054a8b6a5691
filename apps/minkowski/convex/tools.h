// SPDX-License-Identifier: Apache-2.0
//
// Shapes that stand in for the second operand of an offset.
#pragma once

#include "apps/minkowski/convex/convex_cell.h"

namespace nef::minkowski {

/// A polygonal ball about the origin: an octahedron whose edges are split into `splits` parts, every
/// vertex put exactly onto the sphere (4 splits^2 + 2 vertices). Rational: points of the unit sphere are
/// stereographic images of multiples of 2^-20. Symmetric under sign changes of coordinates.
/// Throws InputError unless radius > 0 and 1 <= splits <= 64.
ConvexCell ball(const Rational& radius, int splits, const Monitor& monitor = {});

/// The box [-x/2, x/2] x ... about the origin; flat where an extent is zero. Throws InputError for a
/// negative extent.
ConvexCell box_tool(const Rational3& extents, const Monitor& monitor = {});

}  // namespace nef::minkowski
