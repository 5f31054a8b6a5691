// SPDX-License-Identifier: Apache-2.0
//
// The file of a hull, whole or decimated.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/remeshing/decimate.h"
#include "apps/visual_hull/command/arguments.h"
#include "nef/io/polyhedron_file.h"

namespace nef::visual_hull {

/// Throws nef::InputError if what is asked of the output cannot be had.
void check_output(const Arguments& arguments);

/// What was written: the file, and its mesh if that has been decimated.
struct WrittenHull {
  nef::WrittenFile file;
  std::optional<nef::DecimatedMesh> decimated;
};

/// Writes the hull as the arguments have it: whole, or with --decimate as a mesh of fewer triangles, with --color in
/// colours. `format` is what the session says of files (Session::write_options). Notes about what was done are added to
/// `messages`.
WrittenHull write_hull(const std::string& path, const Result& result, const Arguments& arguments,
                       nef::PolyhedronWriteOptions format, nef::Messages& messages);

/// For the report: `triangles`, `vertices`, and `distance` from the hull (bounds of Hausdorff's, `low` and `high`).
nlohmann::ordered_json decimation_json(const nef::DecimatedMesh& decimated);
/// The same in a line.
std::string decimation_text(const nef::DecimatedMesh& decimated);

}  // namespace nef::visual_hull
