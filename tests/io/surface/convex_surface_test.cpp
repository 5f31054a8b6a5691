// SPDX-License-Identifier: Apache-2.0
//
// Small convex meshes are told from all others: hulls are, and what is not one any more after a change is what a search
// for contacts and open edges, or the hull again, says it is.
#include "nef/mesh/surface/convex_surface.h"

#include <rapidcheck.h>
#include <algorithm>
#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/mesh/mesh_check.h"

namespace nef {
namespace {

bool is_convex(const Mesh& mesh) { return bounds_small_convex_solids(mesh, MeshSurface(mesh, {}), {}); }

Mesh box() {
  Mesh mesh;
  for (long i = 0; i < 8; ++i) mesh.vertices.push_back({Rational(i & 1), Rational(i >> 1 & 1), Rational(i >> 2)});
  for (const std::array<std::uint32_t, 4>& side : {std::array<std::uint32_t, 4>{0, 4, 6, 2},
                                                   {1, 3, 7, 5},
                                                   {0, 1, 5, 4},
                                                   {2, 6, 7, 3},
                                                   {0, 2, 3, 1},
                                                   {4, 5, 7, 6}}) {
    mesh.push_face(side);
  }
  return mesh;
}

// The same faces, without one, turned over or once more.
Mesh with_faces(const Mesh& mesh, const std::vector<std::size_t>& faces) {
  Mesh result;
  result.vertices = mesh.vertices;
  for (const std::size_t f : faces) result.push_face(mesh.face(f));
  return result;
}

// A tetrahedron and lattice points, so that hulls have facets of many corners and points in lines.
std::vector<Rational3> lattice_points() {
  const auto coordinate = []() -> Rational { return Rational(*rc::gen::inRange(-2, 3)) / 2; };
  std::vector<Rational3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (auto more = *rc::gen::inRange(0, 16); more > 0; --more)
    points.push_back({coordinate(), coordinate(), coordinate()});
  return points;
}

void add(Mesh& mesh, const Mesh& more, const Rational3& shift) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Rational3& v : more.vertices) mesh.vertices.push_back({v[0] + shift[0], v[1] + shift[1], v[2] + shift[2]});
  for (std::size_t f = 0; f < more.face_count(); ++f) {
    std::vector<std::uint32_t> face(more.face(f).begin(), more.face(f).end());
    for (std::uint32_t& v : face) v += base;
    mesh.push_face(face);
  }
}

// Together with a far solid of many vertices, a mesh is too large for anything but the search.
bool has_problems_by_search(const Mesh& mesh) {
  std::vector<Rational3> paraboloid;
  for (long i = 0; i < 64; ++i) {
    const long x = i % 8;
    const long y = i / 8;
    paraboloid.push_back({Rational(x), Rational(y), Rational(x * x + y * y)});
  }
  Mesh both = mesh;
  add(both, convex_hull_mesh(paraboloid), {100, 0, 0});
  REQUIRE_FALSE(is_convex(both));
  return !check_mesh(both).empty();
}

}  // namespace

TEST_CASE("boundaries of small convex solids are known") {
  CHECK(is_convex(box()));
  Mesh tetrahedron = convex_hull_mesh(std::vector<Rational3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(is_convex(tetrahedron));
  for (Rational& x : tetrahedron.vertices[0]) x -= 1;
  CHECK(is_convex(tetrahedron));
  CHECK(rc::check("hulls of lattice points", [] {
    const Mesh hull = convex_hull_mesh(lattice_points());
    RC_ASSERT(is_convex(hull));
    RC_ASSERT(!has_problems_by_search(hull));
  }));
}

TEST_CASE("what is no boundary of a convex solid is told from it") {
  const Mesh whole = box();
  CHECK_FALSE(is_convex(with_faces(whole, {0, 1, 2, 3, 4})));
  CHECK_FALSE(is_convex(with_faces(whole, {0, 1, 2, 3, 4, 5, 0})));
  Mesh both_sides;  // of a square: no vertex is beside a face
  both_sides.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  both_sides.push_face(std::array<std::uint32_t, 4>{0, 1, 2, 3});
  both_sides.push_face(std::array<std::uint32_t, 4>{3, 2, 1, 0});
  CHECK_FALSE(is_convex(both_sides));
  CHECK_FALSE(check_mesh(both_sides).empty());
  Mesh inside_out = whole;
  for (std::size_t f = 0; f < 6; ++f)
    std::reverse(inside_out.corners.begin() + 4 * f, inside_out.corners.begin() + 4 * f + 4);
  CHECK_FALSE(is_convex(inside_out));
  Mesh cut = with_faces(whole, {0, 1, 2, 3, 4});  // coplanar triangles are facets together
  cut.push_face(std::array<std::uint32_t, 3>{4, 5, 7});
  cut.push_face(std::array<std::uint32_t, 3>{4, 7, 6});
  CHECK_FALSE(is_convex(cut));
  Mesh idle = whole;
  idle.vertices.push_back({Rational(1) / 2, Rational(1) / 2, Rational(1) / 2});
  CHECK_FALSE(is_convex(idle));
  Mesh twice = whole;
  for (std::size_t f = 0; f < 6; ++f) {
    std::vector<std::uint32_t> face(whole.face(f).begin(), whole.face(f).end());
    for (std::uint32_t& v : face) v += 8;
    twice.push_face(face);
  }
  twice.vertices.insert(twice.vertices.end(), whole.vertices.begin(), whole.vertices.end());
  CHECK_FALSE(is_convex(twice));
}

TEST_CASE("changed hulls are convex only if a search finds nothing") {
  CHECK(rc::check("hulls with a vertex moved or named instead of another", [] {
    Mesh mesh = convex_hull_mesh(lattice_points());
    const auto vertex = *rc::gen::inRange<std::size_t>(0, mesh.vertices.size());
    if (*rc::gen::inRange(0, 2) == 0) {
      mesh.vertices[vertex] = lattice_points().back();
    } else {
      mesh.corners[*rc::gen::inRange<std::size_t>(0, mesh.corners.size())] = static_cast<std::uint32_t>(vertex);
    }
    if (!is_convex(mesh)) return;
    RC_ASSERT(!has_problems_by_search(mesh));
    Mesh hull = convex_hull_mesh(mesh.vertices);
    RC_ASSERT(hull.vertices.size() == mesh.vertices.size());
    RC_ASSERT(hull.face_count() == mesh.face_count());
  }));
}

TEST_CASE("several small convex solids are known where their boxes are apart") {
  Mesh boxes;
  for (long i = 0; i < 20; ++i) add(boxes, box(), {2 * i, i % 3, 0});
  CHECK(is_convex(boxes));
  Mesh touching = boxes;
  add(touching, box(), {39, 1, 0});
  CHECK_FALSE(is_convex(touching));
  Mesh open = boxes;
  open.corners.resize(open.corners.size() - 4);
  open.face_begin.pop_back();
  CHECK_FALSE(is_convex(open));
  Mesh turned = boxes;
  std::reverse(turned.corners.begin(), turned.corners.begin() + 4);
  CHECK_FALSE(is_convex(turned));
  Mesh doubled = boxes;  // a vertex of one box stands where one of another does
  doubled.vertices[8 * 19] = doubled.vertices[0];
  CHECK_FALSE(is_convex(doubled));
  CHECK(rc::check("hulls of lattice points beside each other", [] {
    Mesh mesh;
    for (auto count = *rc::gen::inRange(2, 12); count > 0; --count) {
      add(mesh, convex_hull_mesh(lattice_points()),
          {*rc::gen::inRange(-20, 20), *rc::gen::inRange(-20, 20), *rc::gen::inRange(-2, 3)});
    }
    if (is_convex(mesh)) RC_ASSERT(!has_problems_by_search(mesh));
  }));
}

}  // namespace nef
