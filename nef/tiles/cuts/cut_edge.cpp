// SPDX-License-Identifier: Apache-2.0
//
// The edge is a pole of the sphere, its facets are half circles to the other pole. The plane crosses each of them once,
// in the order in which they lie around the pole: n arcs from the pole to the circle of the plane, which they cut into
// n arcs. Such a map has nothing to simplify: facets and edge were there before, and what lies between the circle's
// arcs and kOutside differs, but for the one sface that is kOutside itself, where the circle is left out.
#include "nef/tiles/cuts/cut_edge.h"

#include <tuple>
#include <utility>

namespace nef {
namespace {

// The line of two planes in the direction n_p x n_q, as svertices name it: the smaller row first, unflipped.
std::pair<PlaneId, PlaneId> named_by_rows(PlaneId p, PlaneId q) {
  if (q.row() < p.row()) {
    std::swap(p, q);
    q = q.opposite();
  }
  return p.flipped() ? std::pair(p.opposite(), q.opposite()) : std::pair(p, q);
}

}  // namespace

bool half_of_cut_edge(const SphereMapView& map, std::uint32_t svertex, PlaneId plane, std::size_t side,
                      SphereMapBuffer& out) {
  out.clear();
  SVertex pole = map.svertices[svertex];
  const std::uint32_t first = pole.out;
  if (first == kNone) return false;
  const bool above = side == 1;
  out.mark = pole.mark;
  pole.out = 0;
  if (!above) pole.q = pole.q.opposite();
  std::tie(pole.p, pole.q) = named_by_rows(pole.p, pole.q);
  out.svertices.push_back(pole);
  // Shalfedge 2 i leaves the pole along facet i, whose sface i is on the left as seen on the way up.
  std::uint32_t outside = kNone;
  std::uint32_t e = first;
  do {
    const auto i = static_cast<std::uint32_t>(out.sfaces.size());
    const SHalfedge facet = map.shalfedges[e];
    SHalfedge half;
    half.mark = facet.mark;
    half.plane = above ? facet.plane : facet.plane.opposite();
    half.source = 0;
    out.shalfedges.push_back(half);
    half.plane = half.plane.opposite();
    half.source = i + 1;
    out.shalfedges.push_back(half);
    SVertex end;
    std::tie(end.p, end.q) = named_by_rows(facet.plane, plane);
    end.out = 2 * i + 1;
    end.mark = facet.mark;
    out.svertices.push_back(end);
    const LabelId mark = map.sfaces[facet.sface].mark;
    if (mark == kOutside) {
      if (outside != kNone) return false;
      outside = i;
    }
    out.sfaces.push_back({i, 1, mark});
    e = map.next_around(e);
  } while (e != first);
  const auto count = static_cast<std::uint32_t>(out.sfaces.size());
  if (count == 1 && outside != kNone) return false;
  const bool open = outside != kNone;
  if (!open) {
    outside = count;
    out.sfaces.push_back({count, 1, kOutside});
  }
  // The arc of the circle that closes sface i, with that on its left.
  const auto arc = [&](std::uint32_t i) { return 2 * (count + i - (open && outside < i ? 1 : 0)); };
  const auto forth = [above](std::uint32_t i) { return 2 * i + (above ? 0 : 1); };  // sface i on the left
  const auto back = [above](std::uint32_t i) { return 2 * i + (above ? 1 : 0); };   // sface i - 1
  const auto after = [count](std::uint32_t i) { return i + 1 == count ? 0 : i + 1; };
  const auto before = [count](std::uint32_t i) { return i == 0 ? count - 1 : i - 1; };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == outside) continue;
    SHalfedge half;
    half.mark = out.sfaces[i].mark;
    half.plane = above ? plane : plane.opposite();
    half.source = 1 + (above ? i : after(i));
    out.shalfedges.push_back(half);
    half.plane = half.plane.opposite();
    half.source = 1 + (above ? after(i) : i);
    out.shalfedges.push_back(half);
  }
  const auto follow = [&out](std::uint32_t one, std::uint32_t next, std::uint32_t sface) {
    out.shalfedges[one].next = next;
    out.shalfedges[next].prev = one;
    out.shalfedges[one].sface = sface;
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == outside) {
      if (above) {
        follow(back(after(i)), forth(i), i);
        follow(forth(i), arc(before(i)) + 1, i);
      } else {
        follow(forth(i), back(after(i)), i);
        follow(back(after(i)), arc(after(i)) + 1, i);
      }
      continue;
    }
    if (above) {
      follow(forth(i), arc(i), i);
      follow(arc(i), back(after(i)), i);
      follow(back(after(i)), forth(i), i);
      follow(arc(i) + 1, before(i) == outside ? back(i) : arc(before(i)) + 1, outside);
    } else {
      follow(forth(i), back(after(i)), i);
      follow(back(after(i)), arc(i), i);
      follow(arc(i), forth(i), i);
      follow(arc(i) + 1, after(i) == outside ? forth(after(i)) : arc(after(i)) + 1, outside);
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) out.entries.push_back({SFaceEntry::Kind::kCycle, forth(i)});
  if (!open) out.entries.push_back({SFaceEntry::Kind::kCycle, arc(0) + 1});
  return true;
}

}  // namespace nef
