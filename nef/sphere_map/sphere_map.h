// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps: planar Nef polyhedra on a small sphere (thesis chapter 3 and 4.1). The same flat
// arrays serve a stand-alone spherical polyhedron and the local pyramids of a complex.
//
// Conventions, valid everywhere:
//  - a direction (svertex) is n_p x n_q for its two oriented planes p, q;
//  - a shalfedge runs counterclockwise about the normal n of its oriented plane, so its sface lies
//    on the positive side of that plane; an arc may be longer than a half circle, up to the full
//    circle if its two ends are one svertex;
//  - shalfedges and sloops come in twin pairs: the twin of i is i ^ 1, with the opposite plane;
//  - inside one sphere map all indices are local: they count from the map's first element.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/geometry/predicates.h"
#include "nef/sphere_map/map_items.h"

namespace nef {

/// A sphere map in somebody's arrays. Valid as long as those do not change. Items with planes are made as they are
/// asked for, since a complex holds topology and planes apart.
struct SphereMapView {
  MapItems<SVertex> svertices;
  MapItems<SHalfedge> shalfedges;
  std::span<const SLoop> sloops;
  std::span<const SFace> sfaces;
  std::span<const SFaceEntry> entries;
  LabelId mark = 0;  ///< of the centre

  [[nodiscard]] std::uint32_t target(std::uint32_t shalfedge) const { return shalfedges[shalfedge ^ 1U].source; }

  /// The next shalfedge that leaves the same svertex, counterclockwise as seen from outside.
  [[nodiscard]] std::uint32_t next_around(std::uint32_t shalfedge) const { return shalfedges[shalfedge].prev ^ 1U; }

  /// True if nothing but one sface is there: a point inside a volume.
  [[nodiscard]] bool trivial() const { return svertices.empty() && sloops.empty(); }
};

/// A sphere map with arrays of its own.
struct SphereMapBuffer {
  std::vector<SVertex> svertices;
  std::vector<SHalfedge> shalfedges;
  std::vector<SLoop> sloops;
  std::vector<SFace> sfaces;
  std::vector<SFaceEntry> entries;
  LabelId mark = 0;

  void clear();
  void assign(const SphereMapView& map);
  [[nodiscard]] SphereMapView view() const { return {svertices, shalfedges, sloops, sfaces, entries, mark}; }

  /// The whole sphere is one sface; the centre has the same mark: a point inside a volume.
  void assign_trivial(LabelId label);

  /// A great circle with its two sides: the local pyramid of a point inside a facet.
  /// `positive` and `negative` are the marks on the sides of the oriented plane.
  void assign_circle(PlaneId plane, LabelId facet, LabelId positive, LabelId negative);
};

/// Calls change(plane) for the plane of every item of a sphere map, which may change it.
template <typename Change>
void for_each_plane(SphereMapBuffer& map, Change&& change) {
  for (SVertex& v : map.svertices) {
    change(v.p);
    change(v.q);
  }
  for (SHalfedge& e : map.shalfedges) change(e.plane);
  for (SLoop& l : map.sloops) change(l.plane);
}

}  // namespace nef
