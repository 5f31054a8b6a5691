// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/complex.h"

#include <algorithm>

namespace nef {

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
  patterns.trim();
  fit(shalfedge_plane.pairs());
  fit(other_planes);
  fit(sloops);
  fit(facets);
  fit(cycle_begin);
  fit(corners);
  fit(isolated_vertices);
  fit(shells);
  fit(volumes);
}

std::size_t Complex::bytes() const {
  const auto size = [](const auto& column) { return column.capacity() * sizeof(*column.begin()); };
  return planes.bytes() + points.bytes() + size(vertices) + patterns.bytes() + size(shalfedge_plane.pairs()) +
         size(other_planes) + size(sloops) + size(svertex_owner) + size(twin) + size(pair_owner) +
         size(shalfedge_facet.pairs()) + size(sloop_facet) + size(sface_shell) + size(facets) + size(cycle_begin) +
         size(corners) + size(isolated_vertices) + size(shells) + size(volumes);
}

}  // namespace nef
