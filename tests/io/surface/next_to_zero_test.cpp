// SPDX-License-Identifier: Apache-2.0
//
// Contacts of faces, facets of hulls, signs of volumes and turns around vertices where they are next to nothing: what
// is true is known by construction.
#include <algorithm>
#include <catch2/catch.hpp>

#include "nef/mesh/mesh_check.h"
#include "nef/polyhedron.h"
#include "tests/support/numbers/next_to_zero.h"

namespace nef::test {
namespace {

void append(Mesh& mesh, const Mesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    std::vector<std::uint32_t> face(other.face(f).begin(), other.face(f).end());
    for (std::uint32_t& v : face) v += base;
    mesh.push_face(face);
  }
}

bool has(const std::vector<MeshProblem>& problems, MeshProblemKind kind) {
  return std::any_of(problems.begin(), problems.end(), [kind](const MeshProblem& p) { return p.kind == kind; });
}

}  // namespace

TEST_CASE("a vertex on a face, a hair beside it or in it: contacts of faces", "[bounds]") {
  NextToZero random(1);
  for (int i = 0; i < 600; ++i) {
    const TwoTetrahedra two = vertex_on_facet(random);
    Mesh mesh = convex_hull_mesh(two.first);
    append(mesh, convex_hull_mesh(two.second));
    const std::vector<MeshProblem> problems = check_mesh(mesh);
    CAPTURE(i, two.shift);
    REQUIRE(has(problems, MeshProblemKind::kSelfIntersection) == (two.shift < 0));
    REQUIRE(has(problems, MeshProblemKind::kTouching) == (two.shift == 0));
    if (two.shift > 0) REQUIRE(problems.empty());
    if (two.shift >= 0) {
      const Polyhedron both = from_mesh(mesh);
      REQUIRE(counts(both).vertices == 8);
      REQUIRE(counts(both).volumes == 3);
    }
  }
}

TEST_CASE("a point in a facet of a hull, a hair above or below it", "[bounds]") {
  NextToZero random(2);
  for (int i = 0; i < 600; ++i) {
    const TwoTetrahedra two = vertex_on_facet(random);
    std::vector<Rational3> points(two.first.begin(), two.first.end());
    points.push_back(two.second[0]);
    const Mesh hull = convex_hull_mesh(points);
    CAPTURE(i, two.shift);
    REQUIRE(hull.vertices.size() == (two.shift > 0 ? 5U : 4U));
    REQUIRE(hull.face_count() == (two.shift > 0 ? 6U : 4U));
    const Counts n = counts(convex_hull(points));
    REQUIRE(n.vertices == hull.vertices.size());
    REQUIRE(n.facets == hull.face_count());
  }
}

TEST_CASE("solids of next to no volume: which way they are turned, and what is built of them", "[bounds]") {
  NextToZero random(3);
  for (int i = 0; i < 600; ++i) {
    const TwoTetrahedra two = vertex_on_facet(random);
    if (two.shift == 0) continue;
    // The facet, and the point next to it as the apex.
    Mesh mesh;
    mesh.vertices = {two.first[0], two.first[1], two.first[2], two.second[0]};
    for (const std::array<std::uint32_t, 3>& face :
         {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      mesh.push_face(face);
    }
    const Rational3 u = from_to(mesh.vertices[0], mesh.vertices[1]);
    const Rational3 v = from_to(mesh.vertices[0], mesh.vertices[2]);
    const Rational3 w = from_to(mesh.vertices[0], mesh.vertices[3]);
    const Rational six =
        w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
    CAPTURE(i, two.shift);
    REQUIRE(has(check_mesh(mesh), MeshProblemKind::kInsideOut) == (six < 0));
    const Polyhedron solid = from_mesh(mesh);
    REQUIRE(*volume(solid) == abs(six) / 6);
    REQUIRE(equal(solid, convex_hull(mesh.vertices)));
  }
}

}  // namespace nef::test
