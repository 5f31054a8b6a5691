// SPDX-License-Identifier: Apache-2.0
//
// Faces that cross or touch themselves, as triangles.
#pragma once

#include <optional>
#include <span>

#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// The mesh with faces that cross or touch themselves replaced by triangles whose sides sum up to theirs: those into
/// which the surface has cut them, or a fan. The first one has the number of the face, so that all other faces keep
/// theirs; the others stand at the end. Nothing if there are no such faces. O(n).
std::optional<Mesh> split_faces(const Mesh& mesh, const MeshSurface& surface, std::span<const FaceContact> contacts);

}  // namespace nef
