// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nef/mesh/mesh.h"

namespace nef {

/// What separate_sheets has done.
struct SeparatedSheets {
  Mesh mesh;
  std::size_t edges = 0;   ///< that had more than two faces
  std::size_t copies = 0;  ///< vertices that were added: further ones at the place of another
};

/// The closed surface of a solid as a two-manifold, every point where it was: where a solid touches itself in an edge
/// or a vertex, each of the sheets that meet there gets vertices of its own, which connect what the inside of the solid
/// connects. So every edge, named by its two vertices, has two faces, and the faces around every vertex form one fan.
/// An edge at both ends of which the sheets are one gets further vertices in its middle; faces there, which must be
/// convex (the middles lie on their sides), are cut. Exact. Faces must be planar, counterclockwise as seen from
/// outside, and must not cross (to_mesh gives such). O(n log n). Throws InputError if an edge is not used equally often
/// in both directions.
SeparatedSheets separate_sheets(const Mesh& mesh);

}  // namespace nef
