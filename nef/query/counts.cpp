// SPDX-License-Identifier: Apache-2.0
//
// What is counted: items and Euler numbers.
#include <algorithm>

#include "nef/complex/predicates_of_sets.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/shell_items.h"

namespace nef {

namespace {

// All shells but those of the volume beyond an infimaximal box and those made of nothing but items of the box.
std::vector<ShellId> shells_in_space(const Complex& c) {
  std::vector<ShellId> result;
  ShellWalk walk(c);
  for (const ShellId s : c.shells.ids()) {
    bool in_space = !c.has_box();
    if (!in_space && c.shells[s].volume != kOuterVolume) {
      walk.visit(
          s, [&](VertexId v) { in_space = in_space || !is_box_vertex(c, v); },
          [&](HalfedgeId h) { in_space = in_space || !is_box_edge(c, h); },
          [&](FacetId f) { in_space = in_space || !is_box_facet(c, f); });
    }
    if (in_space) result.push_back(s);
  }
  return result;
}

}  // namespace

std::vector<long> euler_numbers(const Complex& c) {
  std::vector<long> result;
  ShellWalk walk(c);
  const bool has_box = c.has_box();
  for (const ShellId s : shells_in_space(c)) {
    long& euler = result.emplace_back();
    walk.visit(
        s, [&](VertexId v) { euler += has_box && is_box_vertex(c, v) ? 0 : 1; },
        [&](HalfedgeId h) { euler -= has_box && is_box_edge(c, h) ? 0 : 1; },
        [&](FacetId f) {
          if (has_box && is_box_facet(c, f)) return;
          const Facet& facet = c.facets[f];
          euler += 1 - (static_cast<long>(facet.cycle_count) - 1) - static_cast<long>(facet.isolated_count);
        });
  }
  return result;
}

namespace {

// The boundary near the vertex is a disc: one ring of facets, or one facet.
bool is_manifold_vertex(const Complex& c, VertexId vertex) {
  const SphereMapView map = c.sphere_map(vertex);
  if (map.sfaces.size() != 2) return false;
  if (map.svertices.empty()) return map.sloops.size() == 2;
  // As many arcs as svertices, two at each: rings; two sfaces: one ring.
  if (!map.sloops.empty() || map.shalfedges.size() != 2 * map.svertices.size()) return false;
  std::vector<std::uint32_t> arcs(map.svertices.size(), 0);
  for (const SHalfedge& arc : map.shalfedges) ++arcs[arc.source];
  return std::all_of(arcs.begin(), arcs.end(), [](std::uint32_t n) { return n == 2; });
}

}  // namespace

std::vector<std::optional<long>> genera(const Complex& c) {
  const std::vector<long> euler = euler_numbers(c);
  std::vector<std::optional<long>> result;
  ShellWalk walk(c);
  const auto nothing = [](auto) {};
  for (const ShellId s : shells_in_space(c)) {
    bool manifold = true;
    walk.visit(
        s,
        [&](VertexId v) { manifold = manifold && !(c.has_box() && is_box_vertex(c, v)) && is_manifold_vertex(c, v); },
        nothing, nothing);
    const long number = euler[result.size()];
    result.push_back(manifold ? std::optional<long>((2 - number) / 2) : std::nullopt);
  }
  return result;
}

Counts counts(const Complex& c) {
  if (!c.has_box()) return {c.vertex_count(), c.edge_count(), c.facet_count(), c.volume_count(), c.shells.size()};
  Counts result;
  for (const VertexId v : c.vertex_ids()) result.vertices += is_box_vertex(c, v) ? 0 : 1;
  for (const HalfedgeId h : c.halfedge_ids()) {
    if (h < c.twin[h] && !is_box_edge(c, h)) ++result.edges;
  }
  for (const FacetId f : c.facets.ids()) result.facets += is_box_facet(c, f) ? 0 : 1;
  result.volumes = c.volume_count() - 1;
  result.shells = shells_in_space(c).size();
  return result;
}

std::vector<long> euler_numbers(const Polyhedron& a) { return euler_numbers(a.complex()); }
Counts counts(const Polyhedron& a) { return counts(a.complex()); }

}  // namespace nef
