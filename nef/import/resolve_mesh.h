// SPDX-License-Identifier: Apache-2.0
//
// Solids from meshes, with what was found on the way.
#pragma once

#include <map>
#include <string>

#include "nef/construct/construct.h"
#include "nef/import/checked_surface.h"
#include "nef/import/winding_volume.h"
#include "nef/polyhedron.h"

namespace nef {

struct ResolvedMesh {
  Polyhedron set;
  std::size_t crossing_pairs = 0;  ///< pairs of faces that cross or overlap, or faces that do with themselves
  bool is_arranged = false;        ///< faces were in contact, or components inside of others: winding numbers decided
  bool is_unpaired = false;        ///< edges had an odd number of faces (CheckedSurface::is_unpaired)
  bool inside_out = false;         ///< the mesh enclosed a negative volume and counts as if it were turned over
  int lowest = 0;                  ///< winding number; by kRefuse as if the mesh had been turned over
  int highest = 1;
  std::map<int, WindingVolume> volumes;  ///< by winding number, that of the outer volume left out
};

/// What from_mesh makes of a mesh, without its shortcuts, and the volume for each winding number: the sum of number
/// times volume is the volume that the faces enclose with their signs. By Crossings::kOdd, kOutside and kGuess the
/// numbers are 0 and 1. Throws InputError like from_mesh; `as_surface`, `check` and
/// `close_percent` are not read. Notes what was done to faces. O(n log n) for few contacts, and what measuring takes.
ResolvedMesh resolve_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages = nullptr,
                          Measure measure = Measure::kExactly);
/// The same for a surface that was checked by the rule of the options.
ResolvedMesh resolve_mesh(CheckedSurface&& checked, const MeshOptions& options, Messages* messages, Measure measure);

/// A line about what the rule had to decide, as from_mesh notes it; "" if nothing.
std::string note_about(const ResolvedMesh& resolved, Crossings rule);

}  // namespace nef
