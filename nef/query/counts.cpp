// SPDX-License-Identifier: Apache-2.0
//
// What is counted: items and Euler numbers.
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/predicates_of_sets.h"
#include "nef/query/shell_items.h"

namespace nef {

std::vector<long> euler_numbers(const Complex& c) {
  std::vector<long> result(c.shells.size(), 0);
  ShellWalk walk(c);
  for (std::uint32_t s = 0; s < c.shells.size(); ++s) {
    long& euler = result[s];
    walk.visit(
        s, [&](std::uint32_t) { ++euler; }, [&](std::uint32_t) { --euler; },
        [&](std::uint32_t f) {
          const Facet& facet = c.facets[f];
          euler += 1 - (static_cast<long>(facet.cycle_count) - 1) - static_cast<long>(facet.isolated_count);
        });
  }
  return result;
}

Counts counts(const Complex& c) {
  if (!c.has_box()) return {c.vertex_count(), c.edge_count(), c.facet_count(), c.volume_count(), c.shells.size()};
  Counts result;
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) result.vertices += is_box_vertex(c, v) ? 0 : 1;
  for (std::uint32_t h = 0; h < c.svertices.size(); ++h) {
    if (h < c.twin[h] && !is_box_edge(c, h)) ++result.edges;
  }
  for (std::uint32_t f = 0; f < c.facet_count(); ++f) result.facets += is_box_facet(c, f) ? 0 : 1;
  result.volumes = c.volume_count() - 1;
  ShellWalk walk(c);
  for (std::uint32_t s = 0; s < c.shells.size(); ++s) {
    bool in_space = false;
    walk.visit(
        s, [&](std::uint32_t v) { in_space = in_space || !is_box_vertex(c, v); },
        [&](std::uint32_t h) { in_space = in_space || !is_box_edge(c, h); },
        [&](std::uint32_t f) { in_space = in_space || !is_box_facet(c, f); });
    result.shells += in_space && c.shells[s].volume != 0 ? 1 : 0;
  }
  return result;
}

std::vector<long> euler_numbers(const Polyhedron& a) { return euler_numbers(a.complex()); }
Counts counts(const Polyhedron& a) { return counts(a.complex()); }

}  // namespace nef
