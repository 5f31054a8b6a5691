// SPDX-License-Identifier: Apache-2.0
//
// What planes leave of edges, written down at once, is what overlays on the sphere make of them.
#include "nef/tiles/cuts/cut_edge.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "nef/complex/local_pyramid.h"
#include "nef/geometry/predicates.h"
#include "nef/sphere_map/overlay.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/tiles/cuts/cutter.h"
#include "tests/tiles/cuts.h"

namespace nef::test {
namespace {

void name_outside(SphereMapBuffer& map, LabelId name) {
  const auto change = [name](auto& items) {
    for (auto& item : items) item.mark = item.mark == kOutside ? name : item.mark;
  };
  change(map.svertices);
  change(map.shalfedges);
  change(map.sfaces);
  map.mark = map.mark == kOutside ? name : map.mark;
}

std::vector<std::pair<PlaneId, PlaneId>> names(const SphereMapBuffer& map) {
  std::vector<std::pair<PlaneId, PlaneId>> result;
  for (const SVertex& s : map.svertices) result.emplace_back(s.p, s.q);
  std::sort(result.begin(), result.end());
  return result;
}

// Cuts every edge of a loose complex that crosses the plane; how many could be written down at once.
std::size_t cut_edges(const Complex& c, const PlaneTable& planes, PlaneId plane) {
  std::size_t count = 0;
  SphereOverlay overlay;
  const LabelFunction keep(Cutter::kMarks, 1, [](LabelId mark, LabelId) { return mark; });
  const LabelFunction differ(8, 8, [](LabelId x, LabelId y) { return static_cast<LabelId>(x == y ? 0 : 1); });
  for (const VertexId v : c.vertex_ids()) {
    for (const HalfedgeId h : c.halfedges(v)) {
      if (side_of_plane(planes, plane, c.points, point_of(v), {}) >= 0) continue;
      if (side_of_plane(planes, plane, c.points, point_of(c.target(h)), {}) <= 0) continue;
      SphereMapBuffer pyramid;
      const SphereMapView map = c.sphere_map(v);
      const std::uint32_t position = c.halfedges(v).position(h);
      edge_pyramid(map, position, pyramid);
      for (const std::size_t side : {0U, 1U}) {
        SphereMapBuffer half;
        if (!half_of_cut_edge(map, position, plane, side, half)) continue;
        ++count;
        SphereMapBuffer beyond;
        beyond.assign_circle(plane, 0, side == 0 ? kOutside : 0, side == 0 ? 0 : kOutside);
        SphereMapBuffer expected;
        overlay.overlay(planes, pyramid.view(), beyond.view(), keep, expected, {});
        // Where all facets lie in one plane, the edge has no name of its own.
        const bool flat = std::all_of(pyramid.shalfedges.begin(), pyramid.shalfedges.end(), [&](const SHalfedge& e) {
          return e.plane.row() == pyramid.shalfedges[0].plane.row();
        });
        if (!flat) CHECK(names(half) == names(expected));
        CHECK(half.shalfedges.size() == expected.shalfedges.size());
        CHECK(half.sfaces.size() == expected.sfaces.size());
        CHECK(half.entries.size() == expected.entries.size());
        // svertex 0 is what is left of the edge.
        const Direction edge = direction_of(planes, map.svertices[position]);
        CHECK(same_direction(direction_of(planes, half.svertices[0]), side == 0 ? edge.negated() : edge, {}));
        name_outside(half, 7);
        name_outside(expected, 7);
        SphereMapBuffer difference;
        overlay.overlay(planes, half.view(), expected.view(), differ, difference, {});
        CHECK(difference.view().trivial());
        CHECK(difference.mark == 0);
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("halves of cut edges are those of the overlay") {
  std::size_t count = 0;
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(std::string("halves of cut edges") + (bounded ? " (bounded)" : " (unbounded)"), [&] {
      const Polyhedron a = (*recipes(bounded, 4).as("A")).make();
      const Tiling tiling;
      Cutter cutter(a.complex().planes, tiling, {});
      Complex piece = cutter.loose(a.complex());
      // The second cut meets edges in the wall of the first one.
      for (const std::size_t axis : {0U, 2U, 1U}) {
        const AxisPlane at(axis, Rational(3, 2));
        PlaneTable planes = cutter.planes();
        const PlaneId plane = at.intern(planes);
        count += cut_edges(piece, planes, plane);
        count += cut_edges(piece, planes, plane.opposite());
        piece = std::move(cutter.cut(piece, at)[axis == 2 ? 1 : 0]);
      }
    }));
  }
  CHECK(count > 0);
}

}  // namespace nef::test
