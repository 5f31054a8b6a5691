// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// True if the mesh is known to be the boundary of small convex solids, turned outward, in boxes that are disjoint:
/// nothing is wrong with it then. Exact. One solid has at most 64 vertices, several have at most 16 each, each of which
/// is looked at against each face of its solid: O(n log n) for n solids; false for all larger ones, soon as a rule.
bool bounds_small_convex_solids(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor);

}  // namespace nef
