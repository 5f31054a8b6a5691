// SPDX-License-Identifier: Apache-2.0
//
// Changes the sphere maps of a finished complex in place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "nef/complex/complex.h"
#include "nef/complex/patterns/pattern_interner.h"

namespace nef {

/// Calls change(vertex, map) for each vertex, which may give the items of the sphere map other marks and other planes,
/// but no other numbers. Until it is done, the complex is as it was. O(n).
template <typename Change>
void rewrite_sphere_maps(Complex& c, Change&& change) {
  PatternTable patterns;
  PatternInterner interner;
  std::vector<PlaneId> planes;
  std::vector<PlaneId> others;
  std::vector<SLoop> sloops;
  VertexTable records;
  planes.reserve(c.shalfedge_plane.pairs().size());
  records.reserve(c.vertices.size());
  SphereMapBuffer map;
  for (const VertexId v : c.vertex_ids()) {
    map.assign(c.sphere_map(v));
    change(v, map);
    VertexRecord end = c.vertices[v.next()];
    const PatternId pattern = interner.intern(patterns, map.view(), planes, others);
    end.other_planes = static_cast<std::uint32_t>(others.size());
    records.add(pattern, end);
    sloops.insert(sloops.end(), map.sloops.begin(), map.sloops.end());
  }
  c.vertices = std::move(records);
  c.patterns = std::move(patterns);
  c.shalfedge_plane.pairs() = std::move(planes);
  c.other_planes = std::move(others);
  c.sloops = std::move(sloops);
}

}  // namespace nef
