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

bool is_convex(const Mesh& mesh) { return bounds_small_convex_solid(mesh, MeshSurface(mesh, {}), {}); }

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

// Together with a far box that is cut finely enough, a mesh is too large for anything but the search.
bool has_problems_by_search(const Mesh& mesh) {
  Mesh both = mesh;
  for (long i = 0; i < 9; ++i) {
    const auto base = static_cast<std::uint32_t>(both.vertices.size());
    const Mesh far = box();
    for (const Rational3& v : far.vertices) both.vertices.push_back({v[0] + 100 + 2 * i, v[1], v[2]});
    for (std::size_t f = 0; f < far.face_count(); ++f) {
      std::vector<std::uint32_t> face(far.face(f).begin(), far.face(f).end());
      for (std::uint32_t& v : face) v += base;
      both.push_face(face);
    }
  }
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

}  // namespace nef
