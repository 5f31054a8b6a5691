// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nef/construct/plain_ring.h"
#include "nef/construct/solid.h"
#include "nef/sphere_map/arrangement.h"
#include "nef/synthesis/known_links.h"

namespace nef {

/// Notes, while the sphere maps of a solid are made from its faces, which svertices and shalfedges they become, so that
/// edges and facets need not be found again. A vertex is plain if its map is one ring of all corners around it; edges
/// between plain vertices are edges of faces, and a face whose corners are all plain is a facet or one of several in
/// its plane.
class SolidLinks {
 public:
  /// The faces must outlive this object.
  explicit SolidLinks(const SolidFaces& faces);

  /// The last vertex of the result: it lies at `point`; node n of its drawing leads to point `ends[n]`, arc a stands
  /// for corner `corners[a]` of all faces.
  void note(const Complex& result, std::uint32_t point, const Arrangement& drawing, std::span<const std::uint32_t> ends,
            std::span<const std::uint32_t> corners);

  /// The same for a plain vertex whose corners are given in the order of its ring.
  void note_ring(const Complex& result, std::uint32_t point, std::span<const FaceCorner> ring);

  /// The links of the result, whose planes are those of the faces; nothing if one of these is used nowhere, so that
  /// planes will be renamed.
  [[nodiscard]] std::optional<KnownLinks> finish(const Complex& result);

 private:
  bool note_drawn_ring(const Complex& result, const Arrangement& drawing, std::span<const std::uint32_t> ends,
                       std::span<const std::uint32_t> corners);
  [[nodiscard]] bool every_plane_is_used(const Complex& result) const;
  void link_twins(const Complex& result, KnownLinks& links) const;
  void link_facets(const Complex& result, KnownLinks& links) const;
  bool push_cycle(std::uint32_t face, KnownLinks& links) const;

  const SolidFaces& faces_;
  std::vector<VertexId> vertex_of_;               // of each point: plain vertex of the result, or none
  IndexedVector<VertexId, std::uint32_t> point_;  // of each vertex: that of the faces
  IndexedVector<HalfedgeId, std::uint32_t>
      end_;                                // of each svertex: the point it leads to; kNone if its vertex is not plain
  std::vector<SHalfedgeId> shalfedge_of_;  // of each corner of faces at a plain vertex: on the unflipped plane
};

}  // namespace nef
