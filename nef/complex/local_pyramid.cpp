// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/local_pyramid.h"

#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

void edge_pyramid(const SphereMapView& map, std::uint32_t svertex, SphereMapBuffer& out,
                  std::vector<std::uint32_t>* sfaces) {
  out.clear();
  if (sfaces != nullptr) sfaces->clear();
  SVertex ahead = map.svertices[svertex];
  const std::uint32_t first = ahead.out;
  out.mark = ahead.mark;
  if (first == kNone) {
    const std::uint32_t around = ahead.sface;
    ahead.sface = 0;
    SVertex back = ahead;
    std::swap(back.p, back.q);
    out.svertices = {ahead, back};
    out.entries.push_back({SFaceEntry::Kind::kIsolatedVertex, 0});
    out.entries.push_back({SFaceEntry::Kind::kIsolatedVertex, 1});
    out.sfaces.push_back({0, 2, map.sfaces[around].mark});
    if (sfaces != nullptr) sfaces->push_back(around);
    return;
  }
  std::uint32_t e = first;
  do {
    const auto even = static_cast<std::uint32_t>(out.shalfedges.size());
    SHalfedge half;
    half.mark = map.shalfedges[e].mark;
    half.plane = map.shalfedges[e].plane;
    half.source = 0;
    out.shalfedges.push_back(half);
    half.plane = half.plane.opposite();
    half.source = 1;
    out.shalfedges.push_back(half);
    out.entries.push_back({SFaceEntry::Kind::kCycle, even});
    out.sfaces.push_back({even / 2, 1, map.sfaces[map.shalfedges[e].sface].mark});
    if (sfaces != nullptr) sfaces->push_back(map.shalfedges[e].sface);
    e = map.next_around(e);
  } while (e != first);
  // The lune to the left of half circle i is closed by the way back along half circle i + 1.
  const auto count = static_cast<std::uint32_t>(out.sfaces.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t forth = 2 * i;
    const std::uint32_t back = 2 * ((i + 1) % count) + 1;
    out.shalfedges[forth].next = out.shalfedges[forth].prev = back;
    out.shalfedges[back].next = out.shalfedges[back].prev = forth;
    out.shalfedges[forth].sface = out.shalfedges[back].sface = i;
  }
  ahead.out = 0;
  SVertex back = ahead;
  std::swap(back.p, back.q);
  back.out = 1;
  out.svertices = {ahead, back};
}

LabelId mark_of(const Complex& complex, const ItemRef& item) {
  switch (item.kind) {
    case ItemRef::Kind::kVertex:
      return complex.mark(item.vertex());
    case ItemRef::Kind::kEdge:
      return complex.svertex(item.halfedge()).mark;
    case ItemRef::Kind::kFacet:
      return complex.facets[item.facet()].mark;
    case ItemRef::Kind::kVolume:
    case ItemRef::Kind::kNone:
      break;
  }
  return complex.volumes[item.volume()].mark;
}

void pyramid_of(const Complex& complex, const ItemRef& item, SphereMapBuffer& out) {
  switch (item.kind) {
    case ItemRef::Kind::kVertex:
      out.assign(complex.sphere_map(item.vertex()));
      break;
    case ItemRef::Kind::kEdge: {
      const VertexId vertex = complex.source(item.halfedge());
      edge_pyramid(complex.sphere_map(vertex), complex.halfedges(vertex).position(item.halfedge()), out);
      break;
    }
    case ItemRef::Kind::kFacet: {
      const Facet& facet = complex.facets[item.facet()];
      out.assign_circle(facet.plane, facet.mark, complex.volumes[facet.volume_above].mark,
                        complex.volumes[facet.volume_below].mark);
      break;
    }
    case ItemRef::Kind::kVolume:
    case ItemRef::Kind::kNone:
      out.assign_trivial(complex.volumes[item.volume()].mark);
  }
}

bool is_vertex(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor) {
  if (!map.sloops.empty()) return !map.svertices.empty() || map.mark != map.sloops[0].mark;
  if (map.svertices.empty()) return map.mark != map.sfaces[0].mark;
  if (map.svertices.size() != 2) return true;
  const SVertex& a = map.svertices[0];
  const SVertex& b = map.svertices[1];
  if (a.mark != map.mark || b.mark != map.mark || (a.out == kNone) != (b.out == kNone)) return true;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    if (map.shalfedges[e].source == map.target(e)) return true;
  }
  return !same_direction(direction_of(planes, a), direction_of(planes, b).negated(), monitor);
}

}  // namespace nef
