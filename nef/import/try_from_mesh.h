// SPDX-License-Identifier: Apache-2.0
//
// Meshes of which it is a question whether they bound a solid.
#pragma once

#include <string>
#include <variant>

#include "nef/construct/construct.h"

namespace nef {

/// Why a mesh bounds no solid, as from_mesh words it.
struct MeshRefusal {
  std::string text;
};

/// What from_mesh makes of the mesh, or why it makes nothing of it: for those who go on in either case.
std::variant<Polyhedron, MeshRefusal> try_from_mesh(const Mesh& mesh, const MeshOptions& options = {},
                                                    Messages* messages = nullptr);

}  // namespace nef
