// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/complex.h"

#include <algorithm>

#include "nef/base/capacity.h"
#include "nef/base/threads/parallel.h"

namespace nef {

VertexId Complex::sface_vertex(SFaceId sface) const {
  const auto after = std::upper_bound(vertices.begin(), vertices.end(), sface,
                                      [](SFaceId f, const VertexRecord& v) { return f < v.sfaces; });
  return VertexId{after - vertices.begin() - 1};
}

void name_sides_of_facets(Complex& complex, const Monitor& monitor) {
  constexpr std::size_t kTogether = 16384;
  std::vector<FacetSides> sides(complex.facets.size());
  parallel_for_ranges(sides.size(), kTogether, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    for (std::size_t f = first; f < last; ++f) {
      const SHalfedgeId corner = complex.corners_of(FacetId{f}).front();
      const auto [above, below] = complex.shalfedge_sfaces(corner);
      sides[f] = {complex.shalfedge(corner).mark, complex.sface_volume(above), complex.sface_volume(below)};
    }
  });
  complex.facets.assign_sides(sides);
}

std::vector<HalfedgeId> Complex::bare_edges() const {
  std::vector<bool> has_bare(patterns.size());
  for (std::uint32_t i = 0; i < patterns.size(); ++i) {
    const auto svertices = patterns.svertices(PatternId{i});
    has_bare[i] = std::any_of(svertices.begin(), svertices.end(), [](const SVertex& s) { return s.out == kNone; });
  }
  std::vector<HalfedgeId> result;
  for (const VertexId v : vertex_ids()) {
    const PatternId pattern = vertices.pattern(v);
    if (!has_bare[pattern.index()]) continue;
    const IdRange<HalfedgeId> own = halfedges(v);
    for (const HalfedgeId h : own) {
      if (patterns.svertex(pattern, own.position(h)).out == kNone && h < twin[h]) result.push_back(h);
    }
  }
  return result;
}

void Complex::trim() {
  planes.trim();
  points.trim();
  vertices.trim();
  patterns.trim();
  trim_capacity(shalfedge_plane.pairs());
  trim_capacity(other_planes);
  trim_capacity(sloops);
  facets.trim();
  trim_capacity(cycle_begin);
  trim_capacity(corners);
  trim_capacity(isolated_vertices);
  trim_capacity(shells);
  trim_capacity(volumes);
}

std::size_t Complex::bytes() const {
  return planes.bytes() + points.bytes() + vertices.bytes() + patterns.bytes() + held_bytes(shalfedge_plane.pairs()) +
         held_bytes(other_planes) + held_bytes(sloops) + held_bytes(svertex_owner) + held_bytes(twin) +
         held_bytes(pair_owner) + held_bytes(shalfedge_facet.pairs()) + held_bytes(sloop_facet) +
         held_bytes(sface_shell) + facets.bytes() + held_bytes(cycle_begin) + held_bytes(corners) +
         held_bytes(isolated_vertices) + held_bytes(shells) + held_bytes(volumes);
}

}  // namespace nef
