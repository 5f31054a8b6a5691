// SPDX-License-Identifier: Apache-2.0
//
// The examples of Hachenberger's thesis, real meshes cut and reassembled, and a long cascade.
#include <catch2/catch.hpp>

#include "nef/io/polyhedron_file.h"
#include "tests/support/literals.h"
#include "tests/support/paths.h"

namespace nef::test {
namespace {

Polyhedron rotated_about_all_axes(const Polyhedron& a, double degrees) {
  const double tolerance = degrees / 100;
  AffineMap map = AffineMap::rotate({1, 0, 0}, degrees, tolerance);
  map = AffineMap::rotate({0, 1, 0}, degrees, tolerance).after(map);
  map = AffineMap::rotate({0, 0, 1}, degrees, tolerance).after(map);
  return transform(a, map);
}

bool has_edge(const Complex& c, const Rational3& from, const Rational3& to) {
  for (const HalfedgeId h : c.halfedge_ids()) {
    if (c.points.rational(point_of(c.source(h))) == from && c.points.rational(point_of(c.target(h))) == to) {
      return true;
    }
  }
  return false;
}

}  // namespace

// As figure 1.1: non-manifold edges, a dangling facet, two isolated vertices, an open tunnel.
TEST_CASE("mixed dimensions in one set") {
  const Polyhedron a =
      set("(box(0,0,0,4,4,4) + box(4,4,0,8,8,4) - box(1,-1,1,3,5,3)) + polygon(4,0,2,6,0,2,6,2,2,4,2,2) + "
          "point(7,1,1) - point(6,6,4) + point(2,2,2)");
  CHECK(validate(a.complex()) == "");
  CHECK_FALSE(a.is_closed());
  CHECK_FALSE(a.is_open());
  CHECK_FALSE(a.is_regular());
  CHECK(*volume(a) == 64 + 64 - 16);
  CHECK(contains(a, {4, 4, 2}));        // the edge that the cubes share
  CHECK_FALSE(contains(a, {1, 2, 2}));  // the tunnel's wall went with the tunnel
  CHECK(contains(a, {1, 2, Rational(1, 2)}));
  CHECK(contains(a, {5, 1, 2}));
  CHECK(contains(a, {7, 1, 1}));
  CHECK(contains(a, {2, 2, 2}));
  CHECK_FALSE(contains(a, {6, 6, 4}));
  const Location edge = locate(a, {4, 4, 2});
  CHECK(edge.kind == Location::Kind::kEdge);
  CHECK(edge.mark == 1);
  CHECK(local_pyramid(a, {4, 4, 2}).sfaces.size() == 4);
  CHECK(*volume(closure(a)) == *volume(a));
  CHECK(equal(regularize(a), set("box(0,0,0,4,4,4) + box(4,4,0,8,8,4) - interior(box(1,-1,1,3,5,3))")));
}

// Figures 1.3 and 1.4: the smaller the angle, the closer what must be told apart.
TEST_CASE("a cube meets its rotated copy, down to 1e-40 degrees") {
  const Polyhedron cube = set("box(-1,-1,-1,1,1,1)");
  const Polyhedron seen = intersect(cube, rotated_about_all_axes(cube, 5));
  const std::string expected = count_text(seen);
  for (const double degrees : {1e-2, 1e-6, 1e-20, 1e-40}) {
    INFO(degrees << " degrees");
    const Polyhedron turned = rotated_about_all_axes(cube, degrees);
    CHECK(*volume(turned) == 8);
    CHECK_FALSE(equal(turned, cube));
    const Polyhedron common = intersect(cube, turned);
    CHECK(validate(common.complex()) == "");
    CHECK(count_text(common) == expected);
    const Polyhedron united = unite(cube, turned);
    CHECK(validate(united.complex()) == "");
    CHECK(*volume(common) + *volume(united) == 16);
    CHECK(*volume(common) < 8);
    CHECK(equal(unite(subtract(cube, turned), common), cube));
  }
}

// Figure 4.11: edges of both cubes on one line, with a vertex between them.
TEST_CASE("symmetric difference of two cubes with coplanar sides") {
  const Polyhedron a = set("box(0,0,0,2,2,2) ^ box(1,0,1,3,2,3)");
  CHECK(has_edge(a.complex(), {1, 0, 1}, {2, 0, 1}));
  CHECK(has_edge(a.complex(), {2, 0, 1}, {3, 0, 1}));
  CHECK_FALSE(has_edge(a.complex(), {1, 0, 1}, {3, 0, 1}));
  CHECK(has_edge(a.complex(), {2, 0, 1}, {2, 2, 1}));
  CHECK(*volume(a) == 12);
}

// Figure 6.1: four trapezoids around a tunnel are one facet with a hole.
TEST_CASE("coplanar faces become one facet with a hole") {
  Mesh mesh;
  for (const int z : {0, 1}) {
    for (const int r : {3, 1}) {
      for (const auto& [x, y] : {std::pair{-r, -r}, {r, -r}, {r, r}, {-r, r}}) mesh.vertices.push_back({x, y, z});
    }
  }
  using Face = std::array<std::uint32_t, 4>;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.push_face(Face{8 + i, 8 + j, 12 + j, 12 + i});  // top
    mesh.push_face(Face{j, i, 4 + i, 4 + j});            // bottom
    mesh.push_face(Face{i, j, 8 + j, 8 + i});            // outside
    mesh.push_face(Face{4 + j, 4 + i, 12 + i, 12 + j});  // tunnel
  }
  const Polyhedron block = from_mesh(mesh);
  CHECK(validate(block.complex()) == "");
  CHECK(count_text(block) == "16/24/10/2");
  CHECK(*volume(block) == 32);
  CHECK(equal(block, set("box(-3,-3,0,3,3,1) - interior(box(-1,-1,-1,1,1,2))")));
}

TEST_CASE("real meshes are cut and put together again") {
  for (const char* name : {"star.off", "cross_quad.off", "hole.off", "corner_poly.off"}) {
    INFO(name);
    const Polyhedron a = read_polyhedron(source_folder() + "/data/meshes/" + name);
    CHECK(validate(a.complex()) == "");
    const Polyhedron b = transform(rotated_about_all_axes(a, 17), AffineMap::translate({Rational(1, 7), 0, 0}));
    const Polyhedron common = intersect(a, b);
    const Polyhedron rest = subtract(a, b);
    CHECK(validate(common.complex()) == "");
    CHECK(validate(rest.complex()) == "");
    CHECK_FALSE(common.is_empty());
    CHECK(equal(unite(rest, common), a));
    CHECK(*volume(rest) + *volume(common) == *volume(a));
    CHECK(*volume(a) == *volume(b));
    CHECK(symmetric_difference(unite(a, b), unite(unite(rest, common), subtract(b, a))).is_empty());
  }
}

// Booleans add no planes, so a hundred of them do not make numbers longer.
TEST_CASE("a cascade of 100 operations") {
  const AffineMap turn = AffineMap::rotate({0, 0, 1}, 31, 1e-3);
  const Polyhedron tool = set("box(-1,-1,-1,1,1,1)");
  Polyhedron body = set("box(0,0,0,12,12,3)");
  std::vector<std::pair<Rational3, bool>> history;
  for (int i = 0; i < 100; ++i) {
    const Rational3 at{Rational(i * 7 % 25) / 2, Rational(i * 11 % 25) / 2, Rational(i * 3 % 5)};
    const Polyhedron moved = transform(tool, AffineMap::translate(at).after(turn));
    const bool add = i % 3 == 0;
    body = add ? unite(body, moved) : subtract(body, moved);
    history.emplace_back(at, add);
  }
  CHECK(validate(body.complex()) == "");
  CHECK(body.complex().planes.size() < 500);
  // Membership by replaying the history on points.
  const auto in_tool = [&](const Rational3& p, const Rational3& at) {
    const AffineMap back{
        {{{turn.linear[0][0], turn.linear[1][0], 0}, {turn.linear[0][1], turn.linear[1][1], 0}, {0, 0, 1}}}, {0, 0, 0}};
    const Rational3 local = back({p[0] - at[0], p[1] - at[1], p[2] - at[2]});
    return abs(local[0]) <= 1 && abs(local[1]) <= 1 && abs(local[2]) <= 1;
  };
  for (int i = 0; i < 400; ++i) {
    const Rational3 p{Rational(i * 37 % 29) / 2, Rational(i * 53 % 29) / 2, Rational(i * 17 % 11) / 2};
    bool in = 0 <= p[0] && p[0] <= 12 && 0 <= p[1] && p[1] <= 12 && 0 <= p[2] && p[2] <= 3;
    for (const auto& [at, add] : history) {
      if (in_tool(p, at)) in = add;
    }
    REQUIRE(contains(body, p) == in);
  }
}

}  // namespace nef::test
