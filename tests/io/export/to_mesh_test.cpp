// SPDX-License-Identifier: Apache-2.0
//
// Meshes of polyhedra: the solid that they bound is the regularized bounded part.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/polygon/triangulate.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace nef {
namespace {

// Six times the enclosed volume, from fans of the faces.
Rational six_volumes(const Mesh& mesh) {
  Rational sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Rational3& a = mesh.vertices[face[0]];
      const Rational3& b = mesh.vertices[face[i]];
      const Rational3& c = mesh.vertices[face[i + 1]];
      sum +=
          a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return sum;
}

bool is_closed(const Mesh& mesh) {
  for (const MeshProblem& problem : check_mesh(mesh)) {
    if (!problem.legal) {
      UNSCOPED_INFO(problem.text);
      return false;
    }
  }
  return true;
}

TEST_CASE("A box keeps its polygons or has twelve triangles, nothing is lost") {
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, Rational(1, 3)});
  MeshExportOptions options;
  options.keep_polygons = true;
  const MeshExport polygons = to_mesh(box, options);
  CHECK(polygons.mesh.face_count() == 6);
  CHECK(polygons.lost.empty());
  CHECK(six_volumes(polygons.mesh) == 4);
  const MeshExport triangles = to_mesh(box);
  CHECK(triangles.mesh.vertices.size() == 8);
  CHECK(triangles.mesh.face_count() == 12);
  CHECK(six_volumes(triangles.mesh) == 4);
  CHECK(equal(from_mesh(triangles.mesh), box));
}

TEST_CASE("Facets with holes are triangulated without new vertices") {
  // A plate with nine square holes.
  Polyhedron plate = make_box({0, 0, 0}, {7, 7, 1});
  for (int x = 1; x < 7; x += 2) {
    for (int y = 1; y < 7; y += 2) plate = subtract(plate, interior(make_box({x, y, -1}, {x + 1, y + 1, 2})));
  }
  const MeshExport result = to_mesh(closure(plate));
  CHECK(result.lost.empty());
  CHECK(result.mesh.vertices.size() == 8 + 9 * 8);
  // Two plates with 40 corners and 9 holes, four sides, nine tunnels of four: t = corners + 2 holes - 2.
  CHECK(result.mesh.face_count() == 2 * (40 + 18 - 2) + 8 + 72);
  CHECK(six_volumes(result.mesh) == 6 * (49 - 9));
  CHECK(is_closed(result.mesh));
}

TEST_CASE("Marks of other kinds can be chosen") {
  const Polyhedron box = make_box({0, 0, 0}, {1, 1, 1});
  MeshExportOptions options;
  options.selected = [](LabelId mark) { return mark == 7; };
  CHECK(to_mesh(box, options).mesh.face_count() == 0);
}

TEST_CASE("The mesh of a random bounded set bounds its regularization") {
  CHECK(rc::check("mesh of a bounded set", [] {
    const test::Recipe recipe = *test::recipes(true, 5);
    const Polyhedron whole = recipe.make();
    const MeshExport result = to_mesh(whole);
    const Polyhedron solid = regularize(whole);
    RC_ASSERT(six_volumes(result.mesh) == 6 * *volume(solid));
    RC_ASSERT(result.lost.empty() == equal(solid, whole));
    if (result.mesh.face_count() == 0) {
      RC_ASSERT(solid.is_empty());
      return;
    }
    RC_ASSERT(is_closed(result.mesh));
    RC_ASSERT(equal(from_mesh(result.mesh), solid));
  }));
}

// Triangulates one ring in the plane z = 0 and checks what must hold: the number of triangles, their orientation, area.
void check_ring(const std::vector<Rational3>& corners) {
  const MeshPoints points(corners);
  std::vector<std::uint32_t> ring;
  Rational twice_area = 0;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    ring.push_back(i);
    const Rational3& p = corners[i];
    const Rational3& q = corners[(i + 1) % corners.size()];
    twice_area += p[0] * q[1] - p[1] * q[0];
  }
  REQUIRE(twice_area > 0);
  std::vector<Triangulator::Triangle> triangles;
  REQUIRE(Triangulator(points, {}).triangulate(ring, 2, 1, triangles));
  CHECK(triangles.size() == corners.size() - 2);
  Rational sum = 0;
  for (const auto& t : triangles) {
    const Rational3& a = corners[t[0]];
    const Rational3& b = corners[t[1]];
    const Rational3& c = corners[t[2]];
    const Rational area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    CHECK(area > 0);
    sum += area;
  }
  CHECK(sum == twice_area);
}

TEST_CASE("Polygons: straight corners, combs, spirals, stars with large numbers") {
  check_ring({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  check_ring({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}});
  std::vector<Rational3> comb;
  for (int i = 0; i < 400; ++i) comb.push_back({i, 0, 0});
  for (int i = 399; i >= 0; --i) comb.push_back({i, i % 2 == 0 ? 1 : 100, 0});
  check_ring(comb);
  std::mt19937 random(5);
  std::vector<Rational3> star;
  for (int i = 0; i < 2000; ++i) {
    // Points on rays in order of their angle, at wild distances: a simple polygon.
    const int quarter = i / 500;
    const int step = i % 500;
    const Rational x = 500 - step;
    const Rational y = step;
    const Rational scale(1 + static_cast<int>(random() % 1000), 7);
    const Rational px = scale * x;
    const Rational py = scale * y;
    star.push_back(quarter == 0   ? Rational3{px, py, 0}
                   : quarter == 1 ? Rational3{Rational(-py), px, 0}
                   : quarter == 2 ? Rational3{Rational(-px), Rational(-py), 0}
                                  : Rational3{py, Rational(-px), 0});
  }
  check_ring(star);
}

TEST_CASE("Rings that cross themselves are refused") {
  const std::vector<Rational3> corners{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const MeshPoints points(corners);
  const std::vector<std::uint32_t> ring{0, 1, 2, 3};
  std::vector<Triangulator::Triangle> triangles;
  CHECK_FALSE(Triangulator(points, {}).triangulate(ring, 2, 1, triangles));
  CHECK(triangles.empty());
}

TEST_CASE("Holes that touch, and dangling edges") {
  // Outer square, two square holes that share the corner 6, a dangling edge 10-11 as a hole of its own.
  const std::vector<Rational3> p{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0},
                                 {3, 1, 0}, {3, 5, 0}, {5, 5, 0}, {5, 3, 0}, {7, 7, 0}, {8, 6, 0}};
  const MeshPoints points(p);
  const std::vector<std::vector<std::uint32_t>> rings{{0, 1, 2, 3}, {4, 5, 6, 8, 9, 10, 6, 7}, {11, 12}};
  std::vector<Triangulator::Triangle> triangles;
  REQUIRE(Triangulator(points, {}).triangulate(rings, 2, 1, triangles));
  Rational sum = 0;
  for (const auto& t : triangles) {
    const Rational area =
        (p[t[1]][0] - p[t[0]][0]) * (p[t[2]][1] - p[t[0]][1]) - (p[t[2]][0] - p[t[0]][0]) * (p[t[1]][1] - p[t[0]][1]);
    CHECK(area > 0);
    sum += area;
  }
  CHECK(sum == 2 * (81 - 4 - 4));
}

// A roof of two rectangles that share the ridge, and below it a round body of triangles. Coordinates are thirds, and
// decimals that a sphere's rational points are rounded to.
std::vector<Rational3> roof_over_a_round_body(std::mt19937_64& random) {
  const Rational rise = Rational(static_cast<int>(1 + random() % 5)) / 3;
  std::vector<Rational3> points{{0, 0, 0}, {0, 2, 0}, {1, 0, rise}, {1, 2, rise}, {2, 0, 0}, {2, 2, 0}};
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  std::uniform_real_distribution<double> height(-1, 0.7);
  for (int i = 0; i < 30; ++i) {
    const double z = height(random);
    const double a = angle(random);
    const double r = std::sqrt(1 - z * z);
    const auto decimal = [](double x) { return Rational(static_cast<long>(std::lround(1000 * x)), 1000); };
    points.push_back({1 + decimal(2 * r * std::cos(a)), 1 + decimal(2 * r * std::sin(a)), decimal(2 * z) - 3});
    for (Rational& x : points.back()) x.canonicalize();
  }
  return points;
}

// Corners of polygons are asked about once for each polygon that has them. That they are few is what makes it matter:
// else all vertices are asked about, once.
TEST_CASE("A few polygons with common corners among many triangles are triangulated as they lie") {
  std::mt19937_64 random(3);
  MeshExportOptions as_polygons;
  as_polygons.keep_polygons = true;
  for (int i = 0; i < 20; ++i) {
    const Polyhedron set = convex_hull(roof_over_a_round_body(random));
    const Mesh polygons = to_mesh(set, as_polygons).mesh;
    std::size_t corners = 0;
    for (std::size_t f = 0; f < polygons.face_count(); ++f) {
      if (polygons.face(f).size() > 3) corners += polygons.face(f).size();
    }
    REQUIRE(corners >= 8);
    CHECK(2 * corners < polygons.vertices.size());
    const Mesh triangles = to_mesh(set).mesh;
    CHECK(triangles.face_count() > polygons.face_count());
    CHECK(is_closed(triangles));
    CHECK(six_volumes(triangles) == six_volumes(polygons));
  }
}

}  // namespace
}  // namespace nef
