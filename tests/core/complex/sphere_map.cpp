// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps by themselves: assembly, simplification, point location.
#include "nef/sphere_map/sphere_map.h"

#include <catch2/catch.hpp>

#include "nef/sphere_map/arrangement.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/validation/validate.h"

namespace nef::test {
namespace {

// The planes x = 0, y = 0, z = 0.
struct Planes {
  PlaneTable table;
  PlaneId x = table.intern(1, 0, 0, 0);
  PlaneId y = table.intern(0, 1, 0, 0);
  PlaneId z = table.intern(0, 0, 1, 0);
};

SphereMapBuffer assemble(Arrangement& drawing, const PlaneTable& planes) {
  SphereMapBuffer map;
  drawing.sort_around_nodes(planes, {});
  drawing.simplify_and_assemble(planes, map, {});
  REQUIRE(validate(planes, map.view()) == "");
  return map;
}

LabelId mark_of(const PlaneTable& planes, const SphereMapBuffer& map, int x, int y, int z) {
  return mark_at(map.view(), locate(planes, map.view(), Direction::exact(x, y, z), {}));
}

// The closed octant x, y, z >= 0: three nodes, three quarter circles.
Arrangement octant(const Planes& p) {
  Arrangement drawing;
  drawing.nodes.resize(3);
  drawing.nodes[0].direction = Direction::cross(p.table, p.y, p.z);  // +x
  drawing.nodes[1].direction = Direction::cross(p.table, p.z, p.x);  // +y
  drawing.nodes[2].direction = Direction::cross(p.table, p.x, p.y);  // +z
  for (Arrangement::Node& node : drawing.nodes) node.mark = 1;
  drawing.arcs.push_back({p.z, 0, 1, 1, 1, 0});  // +x to +y counterclockwise about +z
  drawing.arcs.push_back({p.x, 1, 2, 1, 1, 0});
  drawing.arcs.push_back({p.y, 2, 0, 1, 1, 0});
  drawing.centre = 1;
  return drawing;
}

}  // namespace

TEST_CASE("an octant has three svertices, three arcs and two sfaces") {
  const Planes p;
  Arrangement drawing = octant(p);
  const SphereMapBuffer map = assemble(drawing, p.table);
  CHECK(map.svertices.size() == 3);
  CHECK(map.shalfedges.size() == 6);
  CHECK(map.sfaces.size() == 2);
  CHECK(mark_of(p.table, map, 1, 1, 1) == 1);
  CHECK(mark_of(p.table, map, 1, 0, 0) == 1);
  CHECK(mark_of(p.table, map, 1, 1, 0) == 1);
  CHECK(mark_of(p.table, map, 1, 1, -1) == 0);
  CHECK(mark_of(p.table, map, -1, -1, -1) == 0);
  CHECK(mark_of(p.table, map, -1, 0, 0) == 0);
}

TEST_CASE("arcs that separate nothing vanish, and their nodes with them") {
  const Planes p;
  Arrangement drawing = octant(p);
  for (Arrangement::Arc& arc : drawing.arcs) arc.right = 1;  // the outside is marked, too
  const SphereMapBuffer map = assemble(drawing, p.table);
  CHECK(map.view().trivial());
  REQUIRE(map.sfaces.size() == 1);
  CHECK(map.sfaces[0].mark == 1);
}

TEST_CASE("a circle in pieces becomes a sloop") {
  const Planes p;
  Arrangement drawing;
  drawing.nodes.resize(3);
  drawing.nodes[0].direction = Direction::cross(p.table, p.y, p.z);            // +x
  drawing.nodes[1].direction = Direction::cross(p.table, p.z, p.x);            // +y
  drawing.nodes[2].direction = Direction::cross(p.table, p.y, p.z).negated();  // -x
  for (Arrangement::Node& node : drawing.nodes) node.mark = 1;
  drawing.arcs.push_back({p.z, 0, 1, 1, 1, 0});
  drawing.arcs.push_back({p.z, 1, 2, 1, 1, 0});
  drawing.arcs.push_back({p.z, 2, 0, 1, 1, 0});
  drawing.centre = 1;
  const SphereMapBuffer map = assemble(drawing, p.table);
  CHECK(map.svertices.empty());
  REQUIRE(map.sloops.size() == 2);
  CHECK(mark_of(p.table, map, 0, 0, 1) == 1);
  CHECK(mark_of(p.table, map, 0, 0, -1) == 0);
  CHECK(mark_of(p.table, map, 1, -2, 0) == 1);
}

TEST_CASE("a circle with one node of another mark is one arc from it to itself") {
  const Planes p;
  Arrangement drawing;
  drawing.nodes.resize(2);
  drawing.nodes[0].direction = Direction::cross(p.table, p.y, p.z);
  drawing.nodes[1].direction = Direction::cross(p.table, p.y, p.z).negated();
  drawing.nodes[0].mark = 0;
  drawing.nodes[1].mark = 1;
  drawing.arcs.push_back({p.z, 0, 1, 1, 1, 0});
  drawing.arcs.push_back({p.z, 1, 0, 1, 1, 0});
  drawing.centre = 1;
  const SphereMapBuffer map = assemble(drawing, p.table);
  REQUIRE(map.svertices.size() == 1);
  REQUIRE(map.shalfedges.size() == 2);
  CHECK(map.shalfedges[0].source == map.shalfedges[1].source);
  CHECK(mark_of(p.table, map, 1, 0, 0) == 0);
  CHECK(mark_of(p.table, map, -1, 0, 0) == 1);
  CHECK(mark_of(p.table, map, 0, 1, 0) == 1);
  CHECK(mark_of(p.table, map, 0, 1, 1) == 1);
  CHECK(mark_of(p.table, map, 0, 1, -1) == 0);
}

TEST_CASE("an svertex on the far side of a sloop does not hide it") {
  const Planes p;
  Arrangement drawing;
  drawing.circle = {true, p.z, 1, 1, 0};
  drawing.nodes.resize(1);
  drawing.nodes[0].direction = Direction::cross(p.table, p.x, p.y);  // +z, where the mark is 1
  drawing.nodes[0].mark = 0;
  drawing.nodes[0].around = 1;
  drawing.centre = 1;
  const SphereMapBuffer map = assemble(drawing, p.table);
  REQUIRE(map.sfaces.size() == 2);
  CHECK(mark_of(p.table, map, 0, 0, 1) == 0);
  CHECK(mark_of(p.table, map, 0, 0, -1) == 0);  // its antipode, in the other sface
  CHECK(mark_of(p.table, map, 1, 0, -1) == 0);
  CHECK(mark_of(p.table, map, 1, 0, 1) == 1);
}

TEST_CASE("components of a sphere map bound the sfaces that they lie in") {
  const Planes p;
  Arrangement drawing = octant(p);
  // Two antipodal isolated svertices outside of the octant, and one inside it.
  const PlaneId a = PlaneTable(p.table).intern(1, -1, 0, 0);
  PlaneTable planes = p.table;
  const PlaneId diagonal = planes.intern(1, -1, 0, 0);
  const PlaneId other = planes.intern(0, 1, -1, 0);
  static_cast<void>(a);
  Arrangement::Node inside;
  inside.direction = Direction::cross(planes, diagonal, other);
  if (sign_of_dot(inside.direction, Direction::exact(1, 1, 1), {}) < 0) inside.direction = inside.direction.negated();
  inside.mark = 0;
  inside.around = 1;
  drawing.nodes.push_back(inside);
  Arrangement::Node outside;
  outside.direction = inside.direction.negated();
  outside.mark = 1;
  outside.around = 0;
  drawing.nodes.push_back(outside);
  const SphereMapBuffer map = assemble(drawing, planes);
  REQUIRE(map.sfaces.size() == 2);
  CHECK(map.svertices.size() == 5);
  CHECK(mark_of(planes, map, 1, 1, 1) == 0);
  CHECK(mark_of(planes, map, -1, -1, -1) == 1);
  CHECK(mark_of(planes, map, 1, 2, 1) == 1);
  CHECK(mark_of(planes, map, -1, -1, -2) == 0);
}

TEST_CASE("the validator names what is broken in a sphere map") {
  const Planes p;
  Arrangement drawing = octant(p);
  const SphereMapBuffer good = assemble(drawing, p.table);
  SphereMapBuffer map = good;
  map.shalfedges[2].next = 99;
  CHECK(validate(p.table, map.view()).find("indices of a shalfedge in range, shalfedge 2") == 0);
  map = good;
  map.shalfedges[1].mark = 0;
  CHECK(validate(p.table, map.view()).find("twin shalfedges have one mark") == 0);
  map = good;
  for (SFace& face : map.sfaces) face.mark = 1;
  CHECK(validate(p.table, map.view()).find("no redundant arc") == 0);
  map = good;
  std::swap(map.svertices[0].p, map.svertices[0].q);  // the opposite direction
  CHECK(validate(p.table, map.view()) != "");
  map = good;
  map.entries.pop_back();
  CHECK(validate(p.table, map.view()) != "");
}

}  // namespace nef::test
