// SPDX-License-Identifier: Apache-2.0
//
// Whether the components of a closed surface fit together to the border of one solid, told without making it.
#pragma once

#include "nef/base/monitor.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// True if it is shown that the components of the surface (of triangles joined by edges) bound one solid: each that
/// is turned outward lies outside of the others, and each that is turned inward, a cavity, inside of one. False if it
/// is not, which proves nothing: volumes that doubles can not tell from zero, say. The surface must be closed, and its
/// triangles may have nothing in common but vertices and edges, around which they separate inside from outside.
/// O(n log n) for few components.
bool surely_one_solid(const MeshSurface& surface, const Monitor& monitor);

}  // namespace nef
