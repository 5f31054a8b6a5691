// SPDX-License-Identifier: Apache-2.0
#include "nef/query/edge_pyramid.h"

namespace nef {

void edge_pyramid(const Complex& complex, std::uint32_t halfedge, SphereMapBuffer& out,
                  std::vector<std::uint32_t>* sfaces) {
  const std::uint32_t vertex = complex.svertex_owner[halfedge];
  const SphereMapView map = complex.sphere_map(vertex);
  const std::uint32_t first_sface = complex.vertices[vertex].sfaces;
  const SVertex& end = complex.svertices[halfedge];
  out.clear();
  if (sfaces != nullptr) sfaces->clear();
  out.mark = end.mark;
  out.svertices.push_back({end.p, end.q, kNone, kNone, end.mark});
  out.svertices.push_back({end.q, end.p, kNone, kNone, end.mark});
  const auto push_sface = [&](std::uint32_t local, std::uint32_t entry_count) {
    out.sfaces.push_back({static_cast<std::uint32_t>(out.entries.size()), entry_count, map.sfaces[local].mark});
    if (sfaces != nullptr) sfaces->push_back(first_sface + local);
  };
  if (end.out == kNone) {
    out.svertices[0].sface = out.svertices[1].sface = 0;
    push_sface(end.sface, 2);
    out.entries.push_back({SFaceEntry::Kind::kIsolatedVertex, 0});
    out.entries.push_back({SFaceEntry::Kind::kIsolatedVertex, 1});
    return;
  }
  out.svertices[0].out = 0;
  out.svertices[1].out = 1;
  std::uint32_t arc = end.out;
  do {
    const SHalfedge& from = map.shalfedges[arc];
    const auto i = static_cast<std::uint32_t>(out.sfaces.size());
    push_sface(from.sface, 1);
    out.entries.push_back({SFaceEntry::Kind::kCycle, 2 * i});
    out.shalfedges.push_back({from.plane, 0, kNone, kNone, i, from.mark});
    out.shalfedges.push_back({from.plane.opposite(), 1, kNone, kNone, kNone, from.mark});
    arc = map.next_around(arc);
  } while (arc != end.out);
  // Sface i is a lune: up along arc i, back along the other side of the next arc.
  const auto count = static_cast<std::uint32_t>(out.sfaces.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t up = 2 * i;
    const std::uint32_t back = 2 * ((i + 1) % count) + 1;
    out.shalfedges[up].next = out.shalfedges[up].prev = back;
    out.shalfedges[back].next = out.shalfedges[back].prev = up;
    out.shalfedges[back].sface = i;
  }
}

}  // namespace nef
