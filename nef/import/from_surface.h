// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/construct/construct.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// The union of the faces of any mesh as a two-dimensional set: from_mesh with as_surface. Faces that cross, overlap or
/// touch are told apart first, so that as few unions as possible are left to do: O(n log n) if the faces meet in common
/// vertices and edges only. `surface` is the mesh's. Throws InputError for a bad index.
Polyhedron from_surface(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options, Messages* messages);

}  // namespace nef
