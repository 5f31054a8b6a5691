// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/complex.h"

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

void Complex::push_vertex(const SphereMapView& map) {
  vertices.back().mark = map.mark;
  svertices.insert(svertices.end(), map.svertices.begin(), map.svertices.end());
  shalfedges.insert(shalfedges.end(), map.shalfedges.begin(), map.shalfedges.end());
  sloops.insert(sloops.end(), map.sloops.begin(), map.sloops.end());
  sfaces.insert(sfaces.end(), map.sfaces.begin(), map.sfaces.end());
  entries.insert(entries.end(), map.entries.begin(), map.entries.end());
  VertexRecord end;
  end.svertices = static_cast<std::uint32_t>(svertices.size());
  end.shalfedges = static_cast<std::uint32_t>(shalfedges.size());
  end.sloops = static_cast<std::uint32_t>(sloops.size());
  end.sfaces = static_cast<std::uint32_t>(sfaces.size());
  end.entries = static_cast<std::uint32_t>(entries.size());
  vertices.push_back(end);
}

std::size_t Complex::bytes() const {
  const auto size = [](const auto& column) { return column.capacity() * sizeof(column[0]); };
  return planes.bytes() + points.bytes() + size(vertices) + size(svertices) + size(shalfedges) + size(sloops) +
         size(sfaces) + size(entries) + size(svertex_owner) + size(twin) + size(shalfedge_owner) +
         size(shalfedge_facet) + size(sloop_facet) + size(sface_owner) + size(sface_shell) + size(facets) +
         size(cycle_begin) + size(corners) + size(isolated_vertices) + size(shells) + size(shell_sfaces) +
         size(volumes);
}

}  // namespace nef
