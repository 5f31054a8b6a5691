// SPDX-License-Identifier: Apache-2.0
//
// What is written is strictly legal in every format, by an oracle that compares every two triangles in rationals.
#include <catch2/catch.hpp>
#include <random>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/mesh_check.h"
#include "nef/polyhedron.h"
#include "tests/support/shapes/two_manifold.h"
#include "tests/support/strict_mesh.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

constexpr std::array kFiles{std::pair("a.off", false), std::pair("a.obj", false), std::pair("a.ply", false),
                            std::pair("a.stl", false), std::pair("b.ply", true),  std::pair("b.stl", true),
                            std::pair("a.3mf", false), std::pair("a.glb", false)};

bool judged_strict(const Mesh& mesh) {
  const std::vector<MeshProblem> problems = check_mesh(mesh);
  return std::all_of(problems.begin(), problems.end(), is_strictly_legal);
}

// A solid whose coordinates are numbers of no format.
Polyhedron turned_solid(std::mt19937& random, int far) {
  const auto between = [&](int low, int high) { return low + static_cast<int>(random() % unsigned(high - low + 1)); };
  const int kind = between(0, 2);
  const Polyhedron solid = kind == 0   ? make_box({-between(1, 4), -2, -between(1, 4)}, {between(1, 4), 2, 1})
                           : kind == 1 ? make_sphere(between(1, 4), unsigned(between(4, 8)))
                                       : make_cylinder(between(1, 6), 2, 2, unsigned(between(3, 9)));
  const Rational3 axis{between(-1, 1), between(-1, 1), 1};
  const Polyhedron turned = transform(solid, AffineMap::rotate(axis, between(1, 179), 1e-6));
  Rational3 shift;
  for (Rational& x : shift) x = far + Rational(between(-9, 9), 3);
  return transform(turned, AffineMap::translate(shift));
}

}  // namespace

TEST_CASE("Booleans of turned and shifted solids are strictly legal in every format, or refused", "[strict]") {
  std::mt19937 random(11);
  const TemporaryFolder folder;
  int files = 0;
  int refused = 0;
  for (int round = 0; round < 40; ++round) {
    const int far = round % 4 == 3 ? 70000 : 0;
    Polyhedron set = turned_solid(random, far);
    for (int i = 0; i < 2; ++i) {
      const Polyhedron other = turned_solid(random, far);
      set = i == 0 ? subtract(set, other) : unite(set, other);
    }
    for (const auto& [name, binary] : kFiles) {
      ++files;
      try {
        write_polyhedron(folder.file(name), regularize(set), {.binary = binary});
      } catch (const UnsupportedError&) {
        ++refused;
        continue;
      }
      const Mesh mesh = read_mesh(folder.file(name));
      INFO(round << " " << name);
      CHECK(not_strictly_legal(mesh) == "");
      CHECK(judged_strict(mesh));
    }
  }
  CHECK(files == 320);
  CHECK(refused <= 3);
}

TEST_CASE("The strict check and the oracle agree on meshes of few corners", "[strict]") {
  // Tetrahedra on a small grid: they cross, cover, and touch in every way.
  std::mt19937 random(3);
  const auto corner = [&] {
    return Rational3{static_cast<int>(random() % 3), static_cast<int>(random() % 3), static_cast<int>(random() % 3)};
  };
  int legal = 0;
  for (int round = 0; round < 3000; ++round) {
    Mesh mesh;
    for (std::uint32_t k = 0; k < 2; ++k) {
      const std::array p{corner(), corner(), corner(), corner()};
      const Rational volume = dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0])));
      for (const Rational3& x : p) mesh.vertices.push_back(x);
      const std::uint32_t b = 4 * k;
      const std::uint32_t c = volume > 0 ? b + 1 : b + 2;
      const std::uint32_t d = volume > 0 ? b + 2 : b + 1;
      mesh.push_face(std::array{b, d, c});
      mesh.push_face(std::array{b, c, b + 3});
      mesh.push_face(std::array{c, d, b + 3});
      mesh.push_face(std::array{d, b, b + 3});
    }
    const bool strict = judged_strict(mesh);
    INFO(round);
    CHECK(strict == not_strictly_legal(mesh).empty());
    legal += strict ? 1 : 0;
  }
  CHECK(legal > 100);
}

TEST_CASE("Floats far from the origin are refused, written leniently or about the origin", "[strict]") {
  const TemporaryFolder folder;
  const Polyhedron far = transform(make_sphere(1, 16), AffineMap::translate({700000, 1400000, -2100000}));
  for (const auto& [name, binary] : {std::pair("a.glb", false), std::pair("a.stl", true)}) {
    PolyhedronWriteOptions options{.binary = binary};
    CHECK_THROWS_AS(write_polyhedron(folder.file(name), far, options), UnsupportedError);
    CHECK(folder.file_count() == 0);
    options.lenient = true;
    CHECK_FALSE(write_polyhedron(folder.file(name), far, options).problem.empty());
    CHECK(folder.file_count() == 1);
    CHECK_FALSE(judged_strict(read_mesh(folder.file(name))));
    options.lenient = false;
    options.recenter = true;
    const WrittenFile written = write_polyhedron(folder.file(name), far, options);
    CHECK(written.problem.empty());
    CHECK(written.offset == Rational3{700000, 1400000, -2100000});
    Mesh back = read_mesh(folder.file(name));
    CHECK(not_strictly_legal(back) == "");
    // GLB places the mesh where it was.
    const Rational x = back.vertices[0][0];
    CHECK((abs(x - 700000) < 2) == (std::string(name) == "a.glb"));
    std::filesystem::remove(folder.file(name));
  }
}

TEST_CASE("The offset is in files of every format", "[strict]") {
  const TemporaryFolder folder;
  const Polyhedron box = make_box({1000, 2000, -3000}, {1001, 2001, parse_rational("-29990/10")});
  for (const auto& [name, binary] : kFiles) {
    write_polyhedron(folder.file(name), box, {.binary = binary, .recenter = true});
    const Polyhedron back = read_polyhedron(folder.file(name));
    const bool placed = std::string(name) == "a.glb" || std::string(name) == "a.3mf";
    INFO(name);
    CHECK(equal(placed ? back : transform(back, AffineMap::translate({1001, 2001, -2999})), box));
    if (!placed) CHECK(slurp(folder.file(name)).find("offset 1001 2001 -2999") != std::string::npos);
  }
}

TEST_CASE("A vertex that touches a face from outside is a corner of the face's triangles", "[strict]") {
  const std::vector<Rational3> corners{{1, 1, 1}, {0, 0, 2}, {2, 0, 2}, {1, 2, 2}};
  const Polyhedron set = unite(make_box({0, 0, 0}, {3, 3, 1}), convex_hull(corners));
  CHECK(not_strictly_legal(to_mesh(set).mesh) == "");
  // Also in a face that is a triangle.
  const std::vector<Rational3> below{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}, {0, 0, 0}};
  const Polyhedron touched = unite(convex_hull(below), convex_hull(corners));
  CHECK(not_strictly_legal(to_mesh(touched).mesh) == "");
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  CHECK(equal(from_mesh(to_mesh(touched, polygons).mesh), touched));
}

TEST_CASE("Empty sets are valid files of every format", "[strict]") {
  const TemporaryFolder folder;
  for (const auto& [name, binary] : kFiles) {
    write_polyhedron(folder.file(name), Polyhedron(), {.binary = binary});
    CHECK(read_polyhedron(folder.file(name)).is_empty());
  }
  // Lists of glTF are never empty.
  CHECK(slurp(folder.file("a.glb")).find("[]") == std::string::npos);
}

TEST_CASE("Sheets that touch are separated, also where middles of edges are rounded", "[strict]") {
  const TemporaryFolder folder;
  Polyhedron set = unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 0}, {2, 2, 1}));
  set = transform(set, AffineMap::rotate({1, 1, 1}, 31, 1e-6));
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.glb", "a.3mf"}) {
    write_polyhedron(folder.file(name), set, {.manifold = true});
    CHECK(not_strictly_legal(read_mesh(folder.file(name))) == "");
  }
  CHECK(not_two_manifold(read_mesh(folder.file("a.off"))) == "");
  CHECK_THROWS_AS(write_polyhedron(folder.file("a.stl"), set, {.manifold = true}), UnsupportedError);
}

}  // namespace nef::test
