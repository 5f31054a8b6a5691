// SPDX-License-Identifier: Apache-2.0
//
// Decompositions as files.
#pragma once

#include <span>
#include <string>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/construct/construct.h"

namespace nef::minkowski {

/// Writes all cells to one coloured mesh file (off, ply; obj with one group a cell), or, if the path has no
/// extension, into that directory (made if missing) as cell_0001.<format> and so on. Cells of
/// dimension 1 and 0 become edges and points in OFF and OBJ; PLY leaves them out, and `messages` gets a line.
/// Coordinates are nearest doubles, or exact. Throws InputError, also if the directory holds other cells of an
/// earlier run.
void write_cells(const std::string& path, std::span<const ConvexCell> cells, const std::string& format, bool exact,
                 Messages& messages);

}  // namespace nef::minkowski
