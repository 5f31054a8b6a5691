// SPDX-License-Identifier: Apache-2.0
//
// Faces of a mesh that have the same corners.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// For each face the first one with the same corners in any order, by their places; the face itself if there is none
/// before it, if it has no corner, or names a vertex that is not there. Expected O(corners), on the threads of
/// `monitor`.
std::vector<std::uint32_t> first_with_corners(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor);

}  // namespace nef
