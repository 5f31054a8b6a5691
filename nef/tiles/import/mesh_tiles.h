// SPDX-License-Identifier: Apache-2.0
//
// Meshes into tiles, piece by piece.
#pragma once

#include "nef/construct/construct.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef {

/// TiledPolyhedron(from_mesh(...)), without ever holding the whole complex: space is cut until few faces meet a box,
/// and of each box its part of the surface is made a complex, marked by the way its faces are turned. A mesh of fewer
/// faces than `piece`, and one that from_mesh does not take as it is (faces that touch, say), is made whole first.
/// tiling_for() the vertices of the mesh suits few steps. Throws InputError as from_mesh does. O(n log n); memory for
/// the mesh, its check, and a piece for each thread.
TiledPolyhedron tiles_from_mesh(const Mesh& mesh, const MeshOptions& options, const Tiling& tiling,
                                Messages* messages = nullptr, std::size_t piece = 50'000);

}  // namespace nef
