// SPDX-License-Identifier: Apache-2.0
//
// Meshes taken as two-dimensional sets are the unions of their faces, however these meet.
#include <rapidcheck.h>
#include <catch2/catch.hpp>

#include <numeric>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

Mesh triangles(const std::vector<Rational3>& points, const std::vector<std::array<std::uint32_t, 3>>& faces) {
  Mesh mesh;
  mesh.vertices = points;
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

// Faces with fewer than three different corners in a row hold nothing.
Polyhedron by_unions(const Mesh& mesh) {
  Polyhedron sum;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Rational3> ring;
    for (const std::uint32_t v : mesh.face(f)) {
      if (ring.empty() || ring.back() != mesh.vertices[v]) ring.push_back(mesh.vertices[v]);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() >= 3) sum = unite(sum, convex_hull(ring));
  }
  return sum;
}

void check_same(const Mesh& mesh) {
  const Polyhedron set = from_mesh(mesh, MeshOptions{.as_surface = true});
  REQUIRE(validate(set.complex()).empty());
  REQUIRE(equal(set, by_unions(mesh)));
}

}  // namespace

TEST_CASE("A surface with a border keeps it, and coplanar neighbours become one facet", "[surface]") {
  const Mesh square = triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Polyhedron set = from_mesh(square, MeshOptions{.as_surface = true});
  check_same(square);
  CHECK(set.complex().vertex_count() == 4);
  CHECK(contains(set, {Rational(1, 2), Rational(1, 2), 0}));
  CHECK_FALSE(contains(set, {Rational(1, 2), Rational(1, 2), Rational(1, 1000)}));
}

TEST_CASE("Surfaces whose faces meet in every way", "[surface]") {
  const std::vector<Rational3> p = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2}, {1, 1, -1}};
  check_same(triangles(p, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));             // three around an edge
  check_same(triangles(p, {{0, 1, 2}, {0, 1, 2}}));                        // the same twice
  check_same(triangles(p, {{0, 1, 2}, {0, 2, 1}}));                        // and from both sides
  check_same(triangles(p, {{0, 1, 2}, {0, 3, 4}}));                        // a common vertex
  check_same(triangles(p, {{0, 1, 2}, {3, 4, 5}}));                        // crossing
  check_same(triangles(p, {{0, 1, 2}, {0, 1, 1}, {3, 3, 3}, {1, 2, 4}}));  // degenerate ones
  check_same(triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 3}}, {{0, 1, 2}, {3, 4, 5}}));
  check_same(triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}}, {{0, 1, 2}, {3, 4, 5}}));
}

TEST_CASE("Random triangles on a small grid: the surface is the union of its faces", "[surface]") {
  CHECK(rc::check("surface = union of faces", [] {
    const auto count = *rc::gen::inRange<std::size_t>(1, 9);
    std::vector<Rational3> points;
    for (int i = 0; i < 7; ++i) {
      points.push_back({*rc::gen::inRange(0, 4), *rc::gen::inRange(0, 4), *rc::gen::inRange(0, 3)});
    }
    std::vector<std::array<std::uint32_t, 3>> faces(count);
    for (auto& face : faces) {
      for (std::uint32_t& v : face) v = *rc::gen::inRange<std::uint32_t>(0, 7);
    }
    const Mesh mesh = triangles(points, faces);
    Polyhedron set = from_mesh(mesh, MeshOptions{.as_surface = true});
    RC_ASSERT(validate(set.complex()).empty());
    RC_ASSERT(equal(set, by_unions(mesh)));
  }));
}

TEST_CASE("Faces that touch or cross themselves still hold their corners", "[surface]") {
  const auto surface_of = [](const std::vector<Rational3>& points) {
    Mesh mesh;
    mesh.vertices = points;
    std::vector<std::uint32_t> face(points.size());
    std::iota(face.begin(), face.end(), 0U);
    mesh.push_face(face);
    Polyhedron set = from_mesh(mesh, MeshOptions{.as_surface = true});
    CHECK(validate(set.complex()).empty());
    for (const Rational3& p : points) CHECK(contains(set, p));
    return set;
  };
  surface_of({{0, 2, 0}, {0, 2, 2}, {1, 2, -1}, {2, 2, 1}});  // two sides cross
  surface_of({{2, 0, 0}, {2, 2, 0}, {2, 2, 1}, {2, 1, 0}});   // a side runs back along another
  surface_of({{0, 2, 0}, {0, 2, 2}, {0, 2, 1}, {1, 2, 2}});   // and with the corner inside
  // A corner touches a side from within: the area is that of both parts.
  const Polyhedron pinched = surface_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}});
  const std::vector<std::vector<Rational3>> left{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}};
  const std::vector<std::vector<Rational3>> right{{{1, 0, 0}, {2, 0, 0}, {2, 2, 0}}};
  CHECK(equal(pinched, unite(make_polygon(left), make_polygon(right))));
  // Two loops of a crossing face.
  const Polyhedron bow = surface_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}});
  const std::vector<std::vector<Rational3>> lower{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}};
  const std::vector<std::vector<Rational3>> upper{{{0, 2, 0}, {2, 2, 0}, {1, 1, 0}}};
  CHECK(equal(bow, unite(make_polygon(lower), make_polygon(upper))));
  // A square with a square hole, joined to the outer ring by a bridge that is walked twice.
  const Polyhedron keyhole = surface_of(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}});
  const std::vector<std::vector<Rational3>> rings{{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}},
                                                  {{1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}}};
  CHECK(equal(keyhole, make_polygon(rings)));
}

TEST_CASE("Polygons that touch or cross themselves are refused, with the sides", "[surface]") {
  const auto problem = [](const std::vector<Rational3>& ring) -> std::string {
    try {
      make_polygon(std::span(&ring, 1));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(problem({{0, 0, 0}, {0, 0, 2}, {1, 0, -1}, {2, 0, 1}}).find("sides 1-2 and 3-0") != std::string::npos);
  CHECK(problem({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}}).find("sides 0-1 and 2-3") != std::string::npos);
  CHECK(problem({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}).find("sides 0-1 and") != std::string::npos);
  CHECK(problem({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}}).find("sides 1-2 and 3-0") != std::string::npos);
  // Twice around.
  CHECK(problem({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}).find("meet") != std::string::npos);
  CHECK(problem({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).find("one line") != std::string::npos);
  // Straight corners are fine.
  CHECK(problem({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}).empty());
}

TEST_CASE("A solid of one component that touches itself is the solid between its faces", "[surface]") {
  // A bar that is bent into a hook, and from the hook's end a wedge back to the bar, which it touches with its edge
  // inside a face: one closed surface, in contact with itself where it has no common vertices.
  const auto box = [](int x0, int y0, int z0, int x1, int y1, int z1) { return make_box({x0, y0, z0}, {x1, y1, z1}); };
  const Polyhedron hook = unite(unite(box(0, 0, 0, 1, 1, 6), box(1, 0, 5, 4, 1, 6)), box(3, 0, 2, 4, 1, 5));
  const std::vector<Rational3> tip = {
      {3, 0, 2}, {3, 1, 2}, {3, 0, 5}, {3, 1, 5}, {1, Rational(1, 4), 3}, {1, Rational(3, 4), 3}};
  const Polyhedron solid = unite(hook, convex_hull(tip));
  const Mesh bar = to_mesh(hook).mesh;
  const Mesh wedge = to_mesh(convex_hull(tip)).mesh;
  // Without their common square at x = 3.
  const auto on_square = [](const Mesh& m, std::uint32_t f) {
    for (const std::uint32_t v : m.face(f)) {
      if (m.vertices[v][0] != 3) return false;
    }
    return true;
  };
  Mesh joined;
  for (const Mesh* part : {&bar, &wedge}) {
    const auto base = static_cast<std::uint32_t>(joined.vertices.size());
    joined.vertices.insert(joined.vertices.end(), part->vertices.begin(), part->vertices.end());
    for (std::uint32_t f = 0; f < part->face_count(); ++f) {
      if (on_square(*part, f)) continue;
      for (const std::uint32_t v : part->face(f)) joined.corners.push_back(base + v);
      joined.face_begin.push_back(static_cast<std::uint32_t>(joined.corners.size()));
    }
  }
  const Polyhedron read = from_mesh(joined);
  CHECK(validate(read.complex()).empty());
  CHECK(equal(read, solid));
}

}  // namespace nef
