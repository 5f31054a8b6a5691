// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// True if the mesh is small and known to be the boundary of a convex solid, turned outward: nothing is wrong with it
/// then. Exact. At most 64 vertices are looked at, each against each face: O(1); false for all larger meshes.
bool bounds_small_convex_solid(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor);

}  // namespace nef
