// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/subdivide.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/number/nearest_quotient.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"

namespace nef {
namespace {

Mesh mesh_of(const Polyhedron& set) { return to_mesh(set).mesh; }

// A wheel: a double pyramid over a polygon of n corners, whose apices have n edges each.
Mesh double_pyramid(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  mesh.vertices.push_back({0, 0, -1});
  mesh.vertices.push_back({0, 0, 1});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.push_face(std::array{i, next, n + 1});
    mesh.push_face(std::array{next, i, n});
  }
  return mesh;
}

TEST_CASE("Midpoints leave the set as it is, with four times as many triangles") {
  // Thirds have no doubles: the middle of an edge is exact all the same. Two of the boxes meet in an edge.
  const Polyhedron set =
      unite(unite(make_box({0, 0, 0}, {Rational(1, 3), 1, 1}), make_box({Rational(1, 3), 1, 0}, {2, 2, 1})),
            make_box({5, 0, 0}, {6, Rational(5, 7), 1}));
  const Mesh coarse = mesh_of(set);
  for (const unsigned times : {0U, 1U, 3U}) {
    const Mesh fine = subdivide(coarse, SubdivisionScheme::kMidpoint, times);
    CHECK(fine.face_count() == coarse.face_count() << (2 * times));
    CHECK(equal(from_mesh(fine), set));
  }
  // Euler: a closed surface of f triangles has 3f/2 edges, each with one new vertex.
  const Mesh box = mesh_of(make_box({0, 0, 0}, {1, 1, 1}));
  CHECK(subdivide(box, SubdivisionScheme::kMidpoint, 1).vertices.size() == 8 + 18);
}

TEST_CASE("Loop's scheme: the weights of the paper, and volume near that of the limit") {
  // A regular octahedron has valence 4 everywhere. Loop's weight is then
  // a = (40 - (3 + 2 cos 90)^2) / 64 = 31/64: the neighbours of a vertex cancel out, so it moves to 1 - a of itself;
  // the middle of an edge is 3/8 (p + q) + 1/8 of two opposite ones, which cancel out.
  const Mesh octahedron =
      mesh_of(convex_hull(std::array<Rational3, 6>{Rational3{1, 0, 0}, Rational3{-1, 0, 0}, Rational3{0, 1, 0},
                                                   Rational3{0, -1, 0}, Rational3{0, 0, 1}, Rational3{0, 0, -1}}));
  const Mesh once = subdivide(octahedron, SubdivisionScheme::kLoop, 1);
  REQUIRE(once.vertices.size() == 18);
  std::size_t corners = 0;
  for (const Rational3& p : once.vertices) {
    std::multiset<double> size;
    for (const Rational& x : p) size.insert(std::abs(nearest_double(x)));
    if (size.count(0) == 2) {
      ++corners;
      CHECK(*size.rbegin() == Approx(33.0 / 64));
    } else {
      CHECK(*size.begin() == 0);
      CHECK(*size.rbegin() == Approx(3.0 / 8));
    }
  }
  CHECK(corners == 6);
  CHECK(*volume(from_mesh(once)) < *volume(from_mesh(octahedron)));
}

TEST_CASE("Loop's scheme takes vertices of any valence") {
  const Mesh wheel = double_pyramid(200);
  const Mesh fine = subdivide(wheel, SubdivisionScheme::kLoop, 2);
  CHECK(fine.face_count() == 400 * 16);
  // By symmetry the apices stay on the axis: 1 - a + 0 of their height, a -> (40 - 25) / 64 for many edges.
  const double step = 1 - (40 - std::pow(3 + 2 * std::cos(2 * M_PI / 200), 2)) / 64;
  CHECK(nearest_double(subdivide(wheel, SubdivisionScheme::kLoop, 1).vertices[201][2]) == Approx(step));
  CHECK_FALSE(from_mesh(fine).is_empty());
}

TEST_CASE("What cannot be subdivided is refused") {
  Mesh square;
  square.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.push_face(std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK_THROWS_AS(subdivide(square, SubdivisionScheme::kMidpoint, 1), InputError);
  const Mesh pinched = mesh_of(unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 0}, {2, 2, 1})));
  CHECK_THROWS_AS(subdivide(pinched, SubdivisionScheme::kLoop, 1), InputError);
}

}  // namespace
}  // namespace nef
