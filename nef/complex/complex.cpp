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
  return planes.bytes() + points.bytes() + held_bytes(vertices) + patterns.bytes() +
         held_bytes(shalfedge_plane.pairs()) + held_bytes(other_planes) + held_bytes(sloops) +
         held_bytes(svertex_owner) + held_bytes(twin) + held_bytes(pair_owner) + held_bytes(shalfedge_facet.pairs()) +
         held_bytes(sloop_facet) + held_bytes(sface_shell) + held_bytes(facets) + held_bytes(cycle_begin) +
         held_bytes(corners) + held_bytes(isolated_vertices) + held_bytes(shells) + held_bytes(volumes);
}

}  // namespace nef
