// SPDX-License-Identifier: Apache-2.0
//
// Walks through the items of a set: what CGAL's iterators, circulators and shell visitors are for. Items are indices
// into the set's complex (nef/complex/complex.h says what is stored for each).
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include "nef/polyhedron.h"
#include "nef/query/shell_items.h"

namespace nef {

inline auto vertices(const Polyhedron& a) {
  return std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(a.complex().vertex_count()));
}
/// Both halfedges of each edge; a.complex().twin has the other one.
inline auto halfedges(const Polyhedron& a) {
  return std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(a.complex().svertices.size()));
}
inline auto facets(const Polyhedron& a) {
  return std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(a.complex().facet_count()));
}
/// The outer volume comes first.
inline auto volumes(const Polyhedron& a) {
  return std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(a.complex().volume_count()));
}
/// The shells of a volume, its outer one first (volume 0 has none).
inline auto shells(const Polyhedron& a, std::uint32_t volume) {
  const Volume& v = a.complex().volumes[volume];
  return std::views::iota(v.first_shell, v.first_shell + v.shell_count);
}

/// The point of a vertex; InputError for one on an infimaximal box, which is no point of space.
Rational3 point(const Polyhedron& a, std::uint32_t vertex);

/// The cycles of a facet, the outer one first: calls cycle(std::span of vertices in order, facet to the left as seen
/// from the positive side of its plane) for each.
template <typename OnCycle>
void visit_cycles(const Polyhedron& a, std::uint32_t facet, OnCycle&& cycle) {
  const Complex& c = a.complex();
  const Facet& f = c.facets[facet];
  std::vector<std::uint32_t> ring;
  for (std::uint32_t k = f.first_cycle; k < f.first_cycle + f.cycle_count; ++k) {
    ring.clear();
    for (const std::uint32_t corner : c.cycle(k)) ring.push_back(c.shalfedge_owner[corner]);
    cycle(std::span<const std::uint32_t>(ring));
  }
}

/// Calls vertex(v), edge(halfedge; the smaller of the two) and facet(f) for all items of a shell, each once. O(n) for
/// the first call's marks; to visit many shells of one set take a ShellWalk (nef/query/shell_items.h).
template <typename OnVertex, typename OnEdge, typename OnFacet>
void visit_shell(const Polyhedron& a, std::uint32_t shell, OnVertex&& vertex, OnEdge&& edge, OnFacet&& facet) {
  ShellWalk walk(a.complex());
  walk.visit(shell, std::forward<OnVertex>(vertex), std::forward<OnEdge>(edge), std::forward<OnFacet>(facet));
}

}  // namespace nef
