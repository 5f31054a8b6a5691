// SPDX-License-Identifier: Apache-2.0
//
// Decompositions as files.
#pragma once

#include <span>
#include <string>

#include "apps/minkowski/convex_cell.h"

namespace nef::minkowski {

/// Writes all cells to one coloured mesh file (off, ply; obj with one group a cell), or, if the path has no
/// extension, into that directory (made if missing) as cell_0001.<format> and so on. Cells of
/// dimension 1 and 0 become edges and points in OFF, and are left out of the others but .nef.
/// Coordinates are nearest doubles, or exact. Throws InputError.
void write_cells(const std::string& path, std::span<const ConvexCell> cells, const std::string& format, bool exact);

}  // namespace nef::minkowski
