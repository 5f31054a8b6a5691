// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/complex.h"

#include <algorithm>

#include "nef/base/capacity.h"

namespace nef {

VertexId Complex::sface_vertex(SFaceId sface) const {
  const auto after = std::upper_bound(vertices.begin(), vertices.end(), sface,
                                      [](SFaceId f, const VertexRecord& v) { return f < v.sfaces; });
  return VertexId{after - vertices.begin() - 1};
}

void Complex::trim() {
  planes.trim();
  points.trim();
  trim_capacity(vertices);
  patterns.trim();
  trim_capacity(shalfedge_plane.pairs());
  trim_capacity(other_planes);
  trim_capacity(sloops);
  trim_capacity(facets);
  trim_capacity(cycle_begin);
  trim_capacity(corners);
  trim_capacity(isolated_vertices);
  trim_capacity(shells);
  trim_capacity(volumes);
}

std::size_t Complex::bytes() const {
  const auto size = [](const auto& column) { return column.capacity() * sizeof(*column.begin()); };
  return planes.bytes() + points.bytes() + size(vertices) + patterns.bytes() + size(shalfedge_plane.pairs()) +
         size(other_planes) + size(sloops) + size(svertex_owner) + size(twin) + size(pair_owner) +
         size(shalfedge_facet.pairs()) + size(sloop_facet) + size(sface_shell) + size(facets) + size(cycle_begin) +
         size(corners) + size(isolated_vertices) + size(shells) + size(volumes);
}

}  // namespace nef
