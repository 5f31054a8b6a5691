// SPDX-License-Identifier: Apache-2.0
//
// Solids from meshes, with what was found on the way.
#pragma once

#include <map>

#include "nef/construct/construct.h"
#include "nef/import/winding_volume.h"
#include "nef/polyhedron.h"

namespace nef {

struct ResolvedMesh {
  Polyhedron set;
  std::size_t crossing_pairs = 0;        ///< pairs of faces that cross or overlap, or faces that do with themselves
  bool inside_out = false;               ///< the mesh enclosed a negative volume and counts as if it were turned over
  std::map<int, WindingVolume> volumes;  ///< by winding number, that of the outer volume left out
};

/// What from_mesh makes of a mesh, without its shortcuts, and the volume for each winding number: the sum of number
/// times volume is the volume that the faces enclose with their signs. By Crossings::kOdd and kOutside, which do
/// without orientation, the numbers are 0 and 1. Throws InputError like from_mesh; `as_surface` and `check` are not
/// read. O(n log n) for few contacts, and what measuring takes.
ResolvedMesh resolve_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages = nullptr,
                          Measure measure = Measure::kExactly);

}  // namespace nef
