// SPDX-License-Identifier: Apache-2.0
//
// The vertical decomposition (apps/minkowski/decomposition/): convex cells, disjoint inside, few, exactly the set.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/decomposition/wall_axis.h"
#include "apps/minkowski/minkowski.h"
#include "nef/construct/convex_hull.h"
#include "nef/io/mesh/mesh_reader.h"
#include "tests/support/literals.h"
#include "tests/support/numbers/next_to_zero.h"
#include "tests/support/shapes/minkowski_shapes.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::minkowski::ConvexCell;
using nef::minkowski::decompose;
using nef::minkowski::decompose_along;
using nef::minkowski::wall_axis;
using nef::test::set;

// Checks a decomposition against its definition; returns the number of solid cells.
std::size_t check_cells(const Polyhedron& a, const std::vector<ConvexCell>& cells, bool compare_union = true) {
  std::size_t solids = 0;
  Rational content;
  std::vector<Polyhedron> sets;
  for (const ConvexCell& cell : cells) {
    const nef::Hull hull = nef::hull_of(cell.mesh.vertices);
    CHECK(hull.dimension == cell.dimension);
    CHECK(hull.mesh.vertices.size() == cell.mesh.vertices.size());
    CHECK(hull.mesh.face_count() == cell.mesh.face_count());
    sets.push_back(to_polyhedron(cell));
    if (cell.dimension == 3) {
      ++solids;
      content += *nef::volume(sets.back());
    }
    if (compare_union) CHECK(nef::test::valid(sets.back(), "cell").is_bounded());
  }
  // Convex, together as large as the set and together the set: so their interiors are disjoint.
  CHECK(content == *nef::volume(a));
  if (compare_union) CHECK(nef::equal(nef::unite_all(sets), a));
  return solids;
}

TEST_CASE("cells reassemble exactly to the set, whatever its marks") {
  const std::vector<std::string> sets = {
      "box(0,0,0,3,1,1) + box(0,0,0,1,3,1)",
      "interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))",
      "box(0,0,0,3,3,3) - point(1,1,1) - point(2,1,1) - point(1,2,2)",
      "box(0,0,0,3,3,3) - segment(1,1,1, 1,1,2)",
      "box(0,0,0,3,3,3) - segment(1,1,1, 2,2,2) - segment(1,2,1, 2,1,2)",
      "box(0,0,0,3,3,3) - polygon(1,1,1, 2,1,1, 2,2,1, 1,2,1)",
      "box(0,0,0,3,3,3) - polygon(1,1,1, 1,2,1, 1,2,2)",
      "interior(box(0,0,0,3,3,3)) - box(1,1,1,2,2,2)",
      "box(0,0,0,5,3,3) - interior(box(1,1,1,2,2,2)) - box(3,1,1,4,2,2)",
      "box(0,0,0,3,3,1) - box(1,1,-1,2,2,2)",
      "box(0,0,0,2,2,1) - polygon(0,0,1, 1,0,1, 1,1,1, 2,1,1, 2,2,1, 0,2,1)",
      "box(0,0,0,4,4,1) - polygon(1,1,1, 3,1,1, 3,3,1, 1,3,1) - point(1/2,1/2,1)",
      "box(0,0,0,1,1,1) + box(1,1,1,2,2,2) + box(1,1,0,2,2,1)",
      "hull(0,0,0, 4,0,0, 0,4,0, 0,0,4) - interior(hull(0,0,0, 1,0,0, 0,1,0, 0,0,1))",
      "polygon(0,0,0, 4,0,0, 4,4,0, 0,4,0) - polygon(1,1,0, 3,1,0, 3,3,0) - point(1,3,0) - segment(1/2,1/2,0,1/2,3,0)",
      "polygon(0,0,0, 4,0,2, 4,4,4, 1,1,1) + segment(0,0,0, 1,2,3) + point(7,7,7) - point(0,0,0)",
      "box(0,0,0,2,2,2) + segment(1,1,1, 1,1,5) + polygon(2,0,0, 4,0,0, 2,2,2)",
      "box(0,0,0,2,2,2) ^ hull(1,1,1, 3,1,2, 1,3,2, 1,1,4)",
  };
  for (const std::string& text : sets) {
    const Polyhedron a = set(text);
    for (const std::size_t axis : {0U, 1U, 2U}) {
      CAPTURE(text, axis);
      check_cells(a, decompose_along(a, axis, {}));
    }
  }
}

TEST_CASE("cells of solids that touch, or are a hair apart or into each other", "[bounds]") {
  nef::test::NextToZero random(1);
  for (int i = 0; i < 60; ++i) {
    const nef::test::TwoTetrahedra two = vertex_on_facet(random);
    const Polyhedron a = nef::unite(nef::convex_hull(two.first), nef::convex_hull(two.second));
    CAPTURE(i, two.shift);
    for (const std::size_t axis : {0U, 1U, 2U}) check_cells(a, decompose_along(a, axis, {}));
  }
}

TEST_CASE("the same under an oblique rotation, where no wall is parallel to a facet") {
  const nef::AffineMap turn = nef::AffineMap::rotate({Rational(1), Rational(2), Rational(2)}, 37);
  for (const std::string text :
       {"box(0,0,0,3,3,3) - interior(box(1,1,1,2,2,2))", "box(0,0,0,3,3,1) - box(1,1,-1,2,2,2)",
        "interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1) + box(0,0,0,1,1,3))",
        "box(0,0,0,3,3,3) - polygon(1,1,1, 2,1,1, 2,2,1, 1,2,1)"}) {
    CAPTURE(text);
    const Polyhedron a = nef::transform(set(text), turn);
    for (const std::size_t axis : {0U, 1U, 2U}) check_cells(a, decompose_along(a, axis, {}));
  }
}

TEST_CASE("the twisted prism of Schoenhardt, whose reflex edges depend on one another in a circle") {
  // Thesis figure 10.7: three reflex diagonals, each sight wall of which meets the next one's edge's shadow.
  nef::Mesh mesh;
  for (const auto& p :
       std::vector<std::array<int, 3>>{{10, 0, 0}, {-5, 9, 0}, {-5, -9, 0}, {9, 5, 10}, {-9, 5, 10}, {0, -10, 10}}) {
    mesh.vertices.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
  }
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                                                           {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  for (const auto& face : faces) mesh.push_face(face);
  const Polyhedron a = nef::from_mesh(mesh);
  for (const std::size_t axis : {0U, 1U, 2U}) CHECK(check_cells(a, decompose_along(a, axis, {})) >= 3);
}

TEST_CASE("few cells: no wall for an edge that is not reflex") {
  CHECK(decompose(set("box(0,0,0,2,2,2)")).size() == 1);
  CHECK(decompose(set("hull(0,0,0, 4,0,0, 0,4,0, 0,0,4, 3,3,3)")).size() == 1);
  CHECK(decompose(set("box(0,0,0,2,2,2) - point(0,0,0)")).size() == 1);
  CHECK(decompose(set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1)")).size() == 2);
  CHECK(decompose(set("box(-3,-1,0,3,1,1) + box(-1,-3,0,1,3,1)")).size() == 3);  // four reflex edges, two walls
  CHECK(decompose(set("interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))")).size() <= 4);
  CHECK(decompose(set("nothing")).empty());
}

TEST_CASE("cells are the same from run to run") {
  const Polyhedron a = nef::from_mesh(nef::test::star(1, 3.0));
  const std::vector<ConvexCell> first = decompose(a);
  const std::vector<ConvexCell> second = decompose(a);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].mesh.vertices == second[i].mesh.vertices);
    CHECK(first[i].mesh.corners == second[i].mesh.corners);
  }
}

TEST_CASE("the generated mushroom") {
  const nef::Mesh mesh = nef::test::mushroom();
  REQUIRE(mesh.vertices.size() == 226);
  REQUIRE(mesh.face_count() == 448);
  const Polyhedron a = nef::from_mesh(mesh);
  // Walls along z would make 113 cells; CGAL's, which always stand along x, make 72.
  CHECK(wall_axis(a.complex(), {}) != 2);
  CHECK(check_cells(a, decompose(a), false) == 72);
}

TEST_CASE("walls stand along the axis that needs few: a plate with long shafts along one of the others") {
  // Two rows of shafts that cross at different heights: walls along z from one row would cross those from the other.
  const std::string plate = "box(0,0,0, 9,9,5)";
  const Polyhedron along_x = set(plate + " - box(-1,1,1, 10,2,2) - box(-1,4,1, 10,5,2) - box(-1,7,1, 10,8,2)");
  const Polyhedron crossed =
      set(plate +
          " - box(-1,1,1, 10,2,2) - box(-1,4,1, 10,5,2) - box(-1,7,1, 10,8,2) - box(1,-1,3, 2,10,4) -"
          " box(4,-1,3, 5,10,4) - box(7,-1,3, 8,10,4)");
  for (const Polyhedron& a : {along_x, crossed}) {
    const std::size_t chosen = check_cells(a, decompose(a));
    for (const std::size_t axis : {0U, 1U, 2U}) {
      CAPTURE(axis);
      CHECK(chosen <= check_cells(a, decompose_along(a, axis, {})));
    }
  }
}

}  // namespace
