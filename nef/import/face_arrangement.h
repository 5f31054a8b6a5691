// SPDX-License-Identifier: Apache-2.0
//
// The faces of a mesh as one set whose marks tell how often each point is covered.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "nef/construct/construct.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// What the marks of an arrangement of faces count.
enum class Covering : std::uint8_t {
  kSigned,  ///< faces that are turned like the plane less those that are turned the other way
  kParity,  ///< faces, modulo 2
  kAny,     ///< 1 where there are any faces
};

/// How often a facet with this mark is covered.
int net_of_mark(LabelId mark);

/// The faces as a two-dimensional set. Each facet is marked with its covering (net_of_mark), and where that is 0 there
/// is none; its plane is unflipped. Edges and vertices have marks that mean nothing. Faces in contact are put into
/// groups (`contact_groups`), each group is built from the corners of its faces, and the groups are overlaid, smallest
/// first, while their coverings are added: so planes and points of faces without contacts are never compared.
/// No face may be in contact with itself; faces with defects are left out. The surface is that of the mesh, and is gone
/// before the groups are overlaid, which takes as much room. `messages` may be null.
Polyhedron arrange_faces(const Mesh& mesh, std::unique_ptr<const MeshSurface> surface,
                         std::span<const FaceContact> contacts, Covering covering, const MeshOptions& options,
                         Messages* messages);

}  // namespace nef
