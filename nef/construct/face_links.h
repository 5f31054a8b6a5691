// SPDX-License-Identifier: Apache-2.0
//
// Edges and facets of a solid that its faces tell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/construct/plain_ring.h"
#include "nef/construct/solid.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Notes what became of the corners of faces at plain vertices (PlainRing): a side of a face between two of them is an
/// edge, and a face with no other corners is a facet. All else is left to synthesis.
class FaceLinks {
 public:
  /// For so many corners of faces.
  explicit FaceLinks(std::size_t corners) : shalfedges_(corners), svertices_(corners) {}

  /// The vertex whose items begin as the record says was made of this ring of corners, in its order, and their planes.
  void note(const VertexRecord& record, std::span<const FaceCorner> ring, std::span<const PlaneId> planes);

  /// True if most of the corners have been noted, so that what is known is worth listing.
  [[nodiscard]] bool are_many() const { return 2 * noted_ > shalfedges_.size(); }

  /// What is known of the complex that has been made, `corners` being those of all faces, those of point v from
  /// first[v] on. O(n) for a bounded number of faces around a vertex.
  [[nodiscard]] KnownLinks links(const Complex& made, const SolidFaces& faces, std::span<const FaceCorner> corners,
                                 std::span<const std::uint32_t> first) const;

 private:
  void pair_edges(const Complex& made, std::span<const FaceCorner> corners, std::span<const std::uint32_t> first,
                  KnownLinks& known) const;
  void list_facets(const Complex& made, const SolidFaces& faces, KnownLinks& known) const;

  // Of each corner, in the order of the faces; not valid if it is at no plain vertex.
  std::vector<SHalfedgeId> shalfedges_;  // that run around the facet of the face
  std::vector<HalfedgeId> svertices_;    // toward the next corner
  std::size_t noted_ = 0;
};

}  // namespace nef
