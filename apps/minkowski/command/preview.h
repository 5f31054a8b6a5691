// SPDX-License-Identifier: Apache-2.0
//
// Pictures of what a run of `minkowski` took and made.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// Writes NAME.png for each set into a directory, which is made if it is not there. Throws FileError.
void write_previews(const std::string& directory, const std::vector<std::pair<std::string, Polyhedron>>& sets);

/// Writes NAME.png: all sets in one picture, each with a colour of its own.
void write_joint_preview(const std::string& directory, const std::string& name,
                         const std::vector<std::pair<std::string, Polyhedron>>& sets);

/// Writes cells.png: all cells in one picture, each with a colour of its own and a little apart from the others.
void write_cell_preview(const std::string& directory, std::span<const ConvexCell> cells);

}  // namespace nef::minkowski
