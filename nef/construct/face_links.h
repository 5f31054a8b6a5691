// SPDX-License-Identifier: Apache-2.0
//
// Edges and facets of a solid that its faces tell.
#pragma once

#include <cstdint>
#include <span>

#include "nef/base/monitor.h"
#include "nef/construct/plain_ring.h"
#include "nef/construct/solid.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// The faces of a solid by their corners, and what has become of those at plain vertices (PlainRing).
struct PlainVertices {
  const SolidFaces& faces;
  std::span<const FaceCorner> corners;   ///< of all faces; those at plain vertices in the order of the ring
  std::span<const std::uint32_t> first;  ///< of each point among the corners, and the end
  std::span<const VertexId> made;        ///< of each point: the vertex made of its ring; not valid if it is not plain
};

/// What is known of the complex that has been made of the vertices: a side of a face between two plain ones is an edge,
/// and a face with no other corners is a facet. All else is left to synthesis. O(n) for a bounded number of faces
/// around a vertex, on the threads of `monitor`.
KnownLinks face_links(const Complex& made, const PlainVertices& plain, const Monitor& monitor);

}  // namespace nef
