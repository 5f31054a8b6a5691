// SPDX-License-Identifier: Apache-2.0
//
// The faces of convex solids where the boundary of their union may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/union/coplanar.h"

namespace nef::minkowski {

/// Faces of which other cells leave something, or may leave something.
struct VisibleFaces {
  std::vector<std::uint32_t> faces;      ///< in ascending order
  std::vector<Box> boxes;                ///< around what is left of each of them
  std::vector<std::uint8_t> is_visible;  ///< per face of all
  std::size_t hidden_cells = 0;          ///< cells without a visible face
  PlanesOfCells planes;                  ///< those that several cells may share
};

/// Finds them by subtracting other cells from each face, with regard to faces that are in one plane (see coplanar.h),
/// so that the caps of a thousand prisms count as one polygon and the walls between them are hidden. Filters in
/// doubles, on the safe side; that faces are in one plane is exact. `boxes` is a tree over the cells' boxes. Runs on
/// the threads of `monitor`. O(n k) for n faces of cells each of which k others overlap, and less where cells hide each
/// other.
VisibleFaces visible_faces(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
                           ExactCells& exact, const Monitor& monitor);

}  // namespace nef::minkowski
