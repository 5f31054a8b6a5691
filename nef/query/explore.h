// SPDX-License-Identifier: Apache-2.0
//
// Walks through the items of a set: what CGAL's iterators, circulators and shell visitors are for. Items are indices
// into the set's complex (nef/complex/complex.h says what is stored for each).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "nef/polyhedron.h"
#include "nef/query/shell_items.h"

namespace nef {

inline IdRange<VertexId> vertices(const Polyhedron& a) { return a.complex().vertex_ids(); }
/// Both halfedges of each edge; a.complex().twin has the other one.
inline IdRange<HalfedgeId> halfedges(const Polyhedron& a) { return a.complex().halfedge_ids(); }
inline IdRange<FacetId> facets(const Polyhedron& a) { return a.complex().facets.ids(); }
/// The outer volume comes first.
inline IdRange<VolumeId> volumes(const Polyhedron& a) { return a.complex().volumes.ids(); }
/// The shells of a volume, its outer one first (volume 0 has none).
inline IdRange<ShellId> shells(const Polyhedron& a, VolumeId volume) { return a.complex().volumes[volume].shells(); }

/// The point of a vertex; InputError for one on an infimaximal box, which is no point of space.
Rational3 point(const Polyhedron& a, VertexId vertex);

/// The cycles of a facet, the outer one first: calls cycle(std::span of vertices in order, facet to the left as seen
/// from the positive side of its plane) for each.
template <typename OnCycle>
void visit_cycles(const Polyhedron& a, FacetId facet, OnCycle&& cycle) {
  const Complex& c = a.complex();
  std::vector<VertexId> ring;
  for (const CycleId k : c.facets[facet].cycles()) {
    ring.clear();
    for (const SHalfedgeId corner : c.corners_of(k)) ring.push_back(c.shalfedge_vertex(corner));
    cycle(std::span<const VertexId>(ring));
  }
}

/// Calls vertex(v), edge(halfedge; the smaller of the two) and facet(f) for all items of a shell, each once. O(n) for
/// the first call's marks; to visit many shells of one set take a ShellWalk (nef/query/shell_items.h).
template <typename OnVertex, typename OnEdge, typename OnFacet>
void visit_shell(const Polyhedron& a, ShellId shell, OnVertex&& vertex, OnEdge&& edge, OnFacet&& facet) {
  ShellWalk walk(a.complex());
  walk.visit(shell, std::forward<OnVertex>(vertex), std::forward<OnEdge>(edge), std::forward<OnFacet>(facet));
}

}  // namespace nef
