// SPDX-License-Identifier: Apache-2.0
//
// A ring cut in two along a plane through its vertex, and put together, is the ring.
#include "nef/tiles/seams/half_rings.h"

#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/sphere_map/overlay.h"
#include "nef/tiles/cuts/cutter.h"
#include "tests/tiles/cuts.h"

namespace nef::test {
namespace {

// Cuts the maps of all vertices along the planes through them; how many halves could be put together.
std::size_t cut_maps(const Complex& c) {
  std::size_t count = 0;
  SphereOverlay overlay;
  HalfRings rings;
  const LabelFunction keep(Cutter::kMarks, 1, [](LabelId mark, LabelId) { return mark; });
  const LabelFunction differ(Cutter::kMarks, Cutter::kMarks,
                             [](LabelId x, LabelId y) { return static_cast<LabelId>(x == y ? 0 : 1); });
  for (const VertexId v : c.vertex_ids()) {
    if (!c.points.finite(point_of(v))) continue;
    const SphereMapView map = c.sphere_map(v);
    for (const std::size_t axis : {0U, 1U, 2U}) {
      PlaneTable planes = c.planes;
      const PlaneId wall = AxisPlane(axis, c.points.rational(point_of(v))[axis]).intern(planes);
      std::array<SphereMapBuffer, 2> halves;
      for (std::size_t side = 0; side < 2; ++side) {
        SphereMapBuffer beyond;
        beyond.assign_circle(wall, 0, side == 0 ? kOutside : 0, side == 0 ? 0 : kOutside);
        overlay.overlay(planes, map, beyond.view(), keep, halves[side], {});
      }
      for (std::size_t side = 0; side < 2; ++side) {
        SphereMapBuffer joined;
        if (!rings.join(planes, wall.row(), halves[side].view(), halves[1 - side].view(), joined, {})) continue;
        ++count;
        CHECK(joined.svertices.size() == map.svertices.size());
        CHECK(joined.shalfedges.size() == map.shalfedges.size());
        SphereMapBuffer difference;
        overlay.overlay(planes, joined.view(), map, differ, difference, {});
        CHECK(difference.view().trivial());
        CHECK(difference.mark == 0);
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("halves of rings are put together") {
  // About an icosahedron: each corner lies in a plane of two coordinates, with an edge of its.
  std::vector<Rational3> corners;
  for (const int one : {-5, 5}) {
    for (const int other : {-8, 8}) {
      corners.push_back({0, one, other});
      corners.push_back({one, other, 0});
      corners.push_back({other, 0, one});
    }
  }
  CHECK(cut_maps(convex_hull(corners).complex()) >= 24);
  CHECK(rc::check("halves of rings", [] { cut_maps((*recipes(true, 4).as("A")).make().complex()); }));
}

}  // namespace nef::test
