// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls: checked against their definition (every point on or below every face, every
// vertex an input point and extreme, Euler's formula) and against known solids.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

#include "nef/base/error.h"
#include "nef/construct/convex_hull.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/vectors.h"

namespace {

using nef::cross;
using nef::dot;
using nef::Hull;
using nef::minus;
using nef::Rational;
using nef::Rational3;

Rational3 point(int x, int y, int z) { return {Rational(x), Rational(y), Rational(z)}; }

// Checks a hull of dimension 3 against its definition.
void check_solid(const Hull& hull, const std::vector<Rational3>& points) {
  REQUIRE(hull.dimension == 3);
  const nef::Mesh& mesh = hull.mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<std::set<std::size_t>> faces_at(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    REQUIRE(face.size() >= 3);
    const Rational3& o = mesh.vertices[face[0]];
    const Rational3 n = cross(minus(mesh.vertices[face[1]], o), minus(mesh.vertices[face[2]], o));
    REQUIRE_FALSE(nef::is_zero(n));  // no collinear corners
    std::size_t on_face = 0;
    for (const Rational3& v : mesh.vertices) {
      const int side = sgn(dot(n, minus(v, o)));
      REQUIRE(side <= 0);
      if (side == 0) ++on_face;
    }
    REQUIRE(on_face == face.size());  // so no two faces are coplanar
    for (const Rational3& p : points) REQUIRE(sgn(dot(n, minus(p, o))) <= 0);
    for (std::size_t i = 0; i < face.size(); ++i) {
      ++edges[{face[i], face[(i + 1) % face.size()]}];
      faces_at[face[i]].insert(f);
    }
  }
  for (const auto& [edge, count] : edges) {
    REQUIRE(count == 1);
    REQUIRE(edges.count({edge.second, edge.first}) == 1);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    REQUIRE(faces_at[v].size() >= 3);
    REQUIRE(points[hull.source[v]] == mesh.vertices[v]);
  }
  REQUIRE(mesh.vertices.size() + mesh.face_count() == edges.size() / 2 + 2);
}

TEST_CASE("the hull of a grid is its box: coplanar faces are one, inner and edge points are gone") {
  std::vector<Rational3> points;
  for (int i = 0; i < 64; ++i) points.push_back(point(i % 4, i / 4 % 4, i / 16));
  const Hull hull = nef::hull_of(points);
  check_solid(hull, points);
  CHECK(hull.mesh.vertices.size() == 8);
  CHECK(hull.mesh.face_count() == 6);
}

TEST_CASE("hulls of random points on small grids, scaled and moved by fractions") {
  std::mt19937 random(20260);
  for (int round = 0; round < 150; ++round) {
    CAPTURE(round);
    const int size = 2 + round % 6;
    std::uniform_int_distribution<int> coordinate(-size, size);
    std::vector<Rational3> points;
    const Rational scale = round % 3 == 0 ? Rational(1, 3) : Rational(1);
    const Rational shift = round % 5 == 0 ? Rational(1000000007, 7) : Rational(0);
    for (int i = 0; i < 5 + round; ++i) {
      Rational3 p = point(coordinate(random), coordinate(random), coordinate(random));
      for (Rational& x : p) x = x * scale + shift;
      points.push_back(p);
    }
    const Hull hull = nef::hull_of(points);
    if (hull.dimension == 3) check_solid(hull, points);
  }
}

TEST_CASE("points that all but lie in a plane span space") {
  std::vector<Rational3> points;
  for (int i = 0; i < 9; ++i) points.push_back({Rational(i % 3, 7), Rational(i / 3, 7), Rational(1, 3)});
  points[4][2] += Rational(nef::Integer(1), nef::Integer("1000000000000000000000000000000000000000"));
  const Hull hull = nef::hull_of(points);
  check_solid(hull, points);
  CHECK(hull.mesh.vertices.size() == 5);
  CHECK(hull.mesh.face_count() == 5);
}

TEST_CASE("flat hulls: nothing, a point, a segment, a polygon") {
  CHECK(nef::hull_of({}).dimension == -1);
  const std::vector<Rational3> same(5, point(1, 2, 3));
  CHECK(nef::hull_of(same).dimension == 0);
  std::vector<Rational3> line;
  for (int i = 0; i < 5; ++i) line.push_back(point(i, 2 * i, -i));
  const Hull segment = nef::hull_of(line);
  CHECK(segment.dimension == 1);
  CHECK(segment.mesh.vertices == std::vector<Rational3>{line[0], line[4]});
  std::vector<Rational3> plane;
  for (int i = 0; i < 25; ++i) plane.push_back(point(i % 5, i / 5, i % 5 + i / 5));
  const Hull polygon = nef::hull_of(plane);
  CHECK(polygon.dimension == 2);
  CHECK(polygon.mesh.vertices.size() == 4);
  REQUIRE(polygon.mesh.face_count() == 1);
  CHECK(polygon.mesh.face(0).size() == 4);
}

TEST_CASE("a hull mesh of flat points is refused with a reason") {
  const std::vector<Rational3> flat = {point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(1, 1, 0)};
  CHECK_THROWS_AS(nef::convex_hull_mesh(flat), nef::InputError);
  CHECK_THROWS_WITH(nef::convex_hull_mesh(flat), Catch::Contains("lie in a plane"));
}

}  // namespace
