// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// Why a mesh is refused whose faces cancel each other.
inline constexpr const char* kEnclosesNothing = "the faces of the mesh enclose nothing";

/// The solid that a closed mesh encloses once, given the union of its faces as a two-dimensional set: faces may touch
/// and cover each other in any way. Each volume of the surface has a winding number; it changes at a facet by the
/// number of faces that cover it one way less those that cover it the other way. The numbers have to be 0 and 1, or 0
/// and -1: then the mesh is inside out as a whole and is turned over, which `messages` (may be null) is told.
/// Throws InputError naming a face where they are not. O(n log n) for n triangles and facets.
Polyhedron fill_by_winding(const Polyhedron& faces, const Mesh& mesh, const MeshSurface& surface, Messages* messages,
                           const Monitor& monitor);

}  // namespace nef
