// SPDX-License-Identifier: Apache-2.0
//
// Visits the vertices, edges and facets of a shell, each once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "nef/complex/shell_sfaces.h"

namespace nef {

/// Walks shells one after the other. Keeps one stamp for every item of the complex, so that a walk
/// over all shells is O(n).
class ShellWalk {
 public:
  explicit ShellWalk(const Complex& complex)
      : c_(complex),
        vertex_(complex.vertex_count()),
        edge_(complex.svertex_count()),
        facet_(complex.facet_count()),
        sfaces_(complex) {}

  /// Calls vertex(v), edge(halfedge; the smaller of the two) and facet(f) for all items that the
  /// sfaces of `shell` touch. A shell may be walked once.
  template <typename OnVertex, typename OnEdge, typename OnFacet>
  void visit(ShellId shell, OnVertex&& vertex, OnEdge&& edge, OnFacet&& facet) {
    const auto first_time = [shell](ShellId& stamp) {
      const bool fresh = stamp != shell;
      stamp = shell;
      return fresh;
    };
    const auto meet_edge = [&](HalfedgeId halfedge) {
      const HalfedgeId e = c_.edge(halfedge);
      if (first_time(edge_[e])) edge(e);
    };
    const auto meet_facet = [&](FacetId f) {
      if (first_time(facet_[f])) facet(f);
    };
    for (const SFaceId sface : sfaces_.of(shell)) {
      const VertexId v = c_.sface_vertex(sface);
      const VertexRecord& at = c_.vertices[v];
      if (first_time(vertex_[v])) vertex(v);
      const SphereMapView map = c_.sphere_map(v);
      const SFace& face = map.sfaces[sface - at.sfaces];
      for (std::uint32_t i = face.entries; i < face.entries + face.entry_count; ++i) {
        const SFaceEntry& entry = map.entries[i];
        switch (entry.kind) {
          case SFaceEntry::Kind::kIsolatedVertex:
            meet_edge(at.svertices + entry.index);
            break;
          case SFaceEntry::Kind::kLoop:
            meet_facet(facet_of(c_.sloop_facet[at.sloops + entry.index]));
            break;
          case SFaceEntry::Kind::kCycle: {
            std::uint32_t e = entry.index;
            do {
              meet_edge(at.svertices + map.shalfedges[e].source);
              meet_facet(facet_of(c_.shalfedge_facet[at.shalfedges + e]));
              e = map.shalfedges[e].next;
            } while (e != entry.index);
          }
        }
      }
    }
  }

 private:
  const Complex& c_;
  IndexedVector<VertexId, ShellId> vertex_;
  IndexedVector<HalfedgeId, ShellId> edge_;
  IndexedVector<FacetId, ShellId> facet_;
  ShellSfaces sfaces_;
};

}  // namespace nef
