// SPDX-License-Identifier: Apache-2.0
#include "nef/io/solid_mesh.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/recenter.h"
#include "nef/operators.h"
#include "tests/support/shapes/two_manifold.h"

namespace nef {
namespace {

TEST_CASE("The mesh of a set is that of the binary file, repaired likewise") {
  const std::string path = std::filesystem::temp_directory_path() / "solid_mesh_test.ply";
  // Far away enough for sides of a turned ball to cross after rounding.
  for (const int shift : {0, 1 << 20, 1 << 30}) {
    const Polyhedron ball = transform(make_sphere(1, 8), AffineMap::translate({Rational(shift, 3), 1, 2}));
    for (const bool recentered : {false, true}) {
      const PolyhedronWriteOptions file{.binary = true, .manifold = true, .recenter = recentered};
      const WrittenFile written = write_polyhedron(path, ball, file);
      const SolidMesh made = solid_mesh(ball, {.manifold = true, .recenter = recentered, .repair = true});
      CHECK(made.mesh.vertices == read_mesh(path).vertices);
      CHECK(made.offset == written.offset);
      CHECK(test::not_two_manifold(made.mesh) == "");
    }
  }
  std::filesystem::remove(path);
}

TEST_CASE("Exact meshes are the set, moved by the offset") {
  const Polyhedron far = make_box({1000, Rational(1, 3), -7}, {1002, 1, -6});
  const SolidMesh made = solid_mesh(far, {.polygons = true, .recenter = true});
  CHECK(made.mesh.face_count() == 6);
  CHECK(made.offset == Rational3{1002, 0, -6});  // multiples of 2, the box's longest side
  CHECK(equal(transform(from_mesh(made.mesh), AffineMap::translate(made.offset)), far));
}

TEST_CASE("A solid below the resolution of doubles at its place is refused, and can be moved") {
  const Polyhedron speck =
      transform(make_box({0, 0, 0}, {Rational(1, 1 << 30), 1, 1}), AffineMap::translate({1 << 28, 0, 0}));
  CHECK_THROWS_AS(solid_mesh(speck, {.repair = true}), UnsupportedError);
  const SolidMesh moved = solid_mesh(speck, {.recenter = true, .repair = true});
  CHECK(equal(transform(from_mesh(moved.mesh), AffineMap::translate(moved.offset)), speck));
}

TEST_CASE("Middles of few digits") {
  CHECK(middle_of_few_digits({}) == Rational3{});
  const std::vector<Rational3> points{{1000, Rational(1, 3), -7}, {1002, 1, -6}};
  // By hand: the longest side is 2; halves go up. 1001 / 2 = 500.5, (2/3) / 2 = 0.33, -6.5 / 2 = -3.25.
  CHECK(middle_of_few_digits(points) == Rational3{1002, 0, -6});
  CHECK(middle_of_few_digits(std::vector<Rational3>{{5, 6, 7}}) == Rational3{5, 6, 7});
}

}  // namespace
}  // namespace nef
