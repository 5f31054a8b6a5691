// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/separate_sheets.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <set>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/operators.h"
#include "nef/query/measure.h"
#include "tests/support/shapes/two_manifold.h"

namespace nef {
namespace {

using test::not_two_manifold;

Polyhedron cube(int x, int y, int z) { return make_box({x, y, z}, {x + 1, y + 1, z + 1}); }

Mesh mesh_of(const Polyhedron& solid, bool polygons) {
  MeshExportOptions options;
  options.keep_polygons = polygons;
  options.only_quads = true;
  return to_mesh(solid, options).mesh;
}

std::set<Rational3> points_of(const Mesh& mesh) { return {mesh.vertices.begin(), mesh.vertices.end()}; }

TEST_CASE("Cubes that share an edge or a vertex get vertices of their own") {
  const SeparatedSheets edge = separate_sheets(mesh_of(cube(0, 0, 0) + cube(1, 1, 0), true));
  CHECK(edge.edges == 1);
  CHECK(edge.copies == 2);
  CHECK(edge.mesh.vertices.size() == 16);
  CHECK(not_two_manifold(edge.mesh) == "");
  const SeparatedSheets vertex = separate_sheets(mesh_of(cube(0, 0, 0) + cube(1, 1, 1), true));
  CHECK(vertex.edges == 0);
  CHECK(vertex.copies == 1);
  CHECK(not_two_manifold(vertex.mesh) == "");
  const Mesh plain = mesh_of(cube(0, 0, 0), true);
  const SeparatedSheets nothing = separate_sheets(plain);
  CHECK(nothing.copies == 0);
  CHECK(nothing.mesh.corners == plain.corners);
}

TEST_CASE("An edge whose ends the solid connects is split in its middle") {
  // Above and below the cubes that touch, their other two neighbours are filled: one solid around both ends.
  Polyhedron solid = cube(0, 0, 1) + cube(1, 1, 1);
  for (const int z : {0, 2}) solid = solid + make_box({0, 0, z}, {2, 2, z + 1});
  const Mesh before = mesh_of(solid, false);
  CHECK(not_two_manifold(before) != "");
  const SeparatedSheets after = separate_sheets(before);
  CHECK(after.edges == 1);
  CHECK(not_two_manifold(after.mesh) == "");
  CHECK(points_of(after.mesh).contains(Rational3{1, 1, Rational(3, 2)}));
  CHECK(equal(from_mesh(after.mesh), solid));
}

TEST_CASE("Random voxels: each edge has two faces, and the solid is the same") {
  REQUIRE(rc::check("two-manifold", [] {
    const auto filled = *rc::gen::container<std::vector<bool>>(27, rc::gen::arbitrary<bool>());
    Polyhedron solid;
    for (int k = 0; k < 27; ++k) {
      if (filled[static_cast<std::size_t>(k)]) solid = solid + cube(k % 3, k / 3 % 3, k / 9);
    }
    for (const bool polygons : {false, true}) {
      const SeparatedSheets after = separate_sheets(mesh_of(solid, polygons));
      RC_ASSERT(not_two_manifold(after.mesh) == "");
      RC_ASSERT(equal(after.mesh.vertices.empty() ? Polyhedron() : from_mesh(after.mesh), solid));
    }
  }));
}

TEST_CASE("A surface with a border is refused") {
  Mesh open;
  open.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  open.push_face(std::array<std::uint32_t, 3>{0, 1, 2});
  CHECK_THROWS_AS(separate_sheets(open), InputError);
}

}  // namespace
}  // namespace nef
