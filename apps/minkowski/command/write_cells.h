// SPDX-License-Identifier: Apache-2.0
//
// Decompositions as files.
#pragma once

#include <span>
#include <string>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/construct/construct.h"
#include "nef/io/polyhedron_file.h"

namespace nef::minkowski {

/// How cells are written.
struct CellFiles {
  std::string format = "off";  ///< of files in a directory: a mesh format (mesh_formats.h) or nef
  bool exact = false;          ///< coordinates
  bool binary = false;         ///< binary instead of text, in formats of two forms
  bool recenter = false;       ///< subtract the middle of all cells; not for nef
  bool lenient = false;        ///< write solid cells that rounding makes illegal as they are
};

/// Writes all cells to one mesh file, each a group of faces (see MeshWriteOptions), or, if the path has no
/// extension, into that directory (made if missing) as cell_0001.<format> and so on. Cells of dimension 1 and 0 become
/// lines and points; formats that have none leave them out, and `messages` gets a line.
/// Coordinates are nearest doubles, or exact; each cell has vertices of its own. Throws InputError, also if the
/// directory holds other cells of an earlier run, and UnsupportedError if rounding makes a solid cell strictly illegal
/// (is_strictly_legal), unless `files` is lenient; then nothing is written. Returns what was subtracted from all
/// coordinates, and what is illegal.
WrittenFile write_cells(const std::string& path, std::span<const ConvexCell> cells, const CellFiles& files,
                        Messages& messages);

}  // namespace nef::minkowski
