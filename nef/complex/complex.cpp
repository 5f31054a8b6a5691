// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/complex.h"

#include <algorithm>

namespace nef {

SphereMapView Complex::sphere_map(std::uint32_t vertex) const {
  const VertexRecord& first = vertices[vertex];
  const VertexRecord& last = vertices[vertex + 1];
  return {std::span(svertices.data() + first.svertices, last.svertices - first.svertices),
          std::span(shalfedges.data() + first.shalfedges, last.shalfedges - first.shalfedges),
          std::span(sloops.data() + first.sloops, last.sloops - first.sloops),
          std::span(sfaces.data() + first.sfaces, last.sfaces - first.sfaces),
          std::span(entries.data() + first.entries, last.entries - first.entries),
          first.mark};
}

std::uint32_t Complex::sface_vertex(std::uint32_t sface) const {
  const auto after = std::upper_bound(vertices.begin(), vertices.end(), sface,
                                      [](std::uint32_t f, const VertexRecord& v) { return f < v.sfaces; });
  return static_cast<std::uint32_t>(after - vertices.begin() - 1);
}

void Complex::trim() {
  const auto fit = [](auto& column) {
    if (column.capacity() - column.size() > column.capacity() / 8) column.shrink_to_fit();
  };
  planes.trim();
  points.trim();
  fit(vertices);
  fit(svertices);
  fit(shalfedges);
  fit(sloops);
  fit(sfaces);
  fit(entries);
  fit(facets);
  fit(cycle_begin);
  fit(corners);
  fit(isolated_vertices);
  fit(shells);
  fit(volumes);
}

std::size_t Complex::bytes() const {
  const auto size = [](const auto& column) { return column.capacity() * sizeof(*column.begin()); };
  return planes.bytes() + points.bytes() + size(vertices) + size(svertices) + size(shalfedges) + size(sloops) +
         size(sfaces) + size(entries) + size(svertex_owner) + size(twin) + size(shalfedge_owner.pairs()) +
         size(shalfedge_facet.pairs()) + size(sloop_facet) + size(sface_shell) + size(facets) + size(cycle_begin) +
         size(corners) + size(isolated_vertices) + size(shells) + size(shell_sfaces) + size(volumes);
}

}  // namespace nef
