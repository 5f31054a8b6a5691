// SPDX-License-Identifier: Apache-2.0
//
// The faces of a mesh in groups that can be built without an arrangement.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// The connected components of a mesh, in which common vertices join faces: of each face the first face of its
/// component, kNone for faces without corners. No index may be bad. O(n).
std::vector<std::uint32_t> face_components(const Mesh& mesh, const MeshSurface& surface);

/// Puts the faces into groups so that no two faces in contact come into one group. A component without contacts within
/// itself stays whole while there are few groups, for every border of a group costs vertices that have to be joined
/// later; it is put into the first group in which nothing is in contact with it. The faces of other components are put
/// into groups one by one, and nearly all come to be in the first one. `component` names the component of each face;
/// faces for which it is kNone are left out. Faces in groups are in order. O(faces + contacts).
std::vector<std::vector<std::uint32_t>> contact_groups(std::span<const FaceContact> contacts,
                                                       std::span<const std::uint32_t> component);

}  // namespace nef
