// SPDX-License-Identifier: Apache-2.0
#include "nef/remeshing/decimate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "tests/support/paths.h"

namespace nef {
namespace {

Polyhedron sphere() { return from_mesh(read_mesh(source_folder() + "/data/meshes/sphere.ply")); }

bool is_subset(const Polyhedron& a, const Polyhedron& b) { return subtract(a, b).is_empty(); }

std::set<Rational3> vertices_of(const Polyhedron& set) {
  std::set<Rational3> result;
  const Complex& c = set.complex();
  for (const VertexId v : c.vertex_ids()) result.insert(c.points.rational(point_of(v)));
  return result;
}

TEST_CASE("A decimated sphere is legal, smaller, made of old vertices, and near") {
  const Polyhedron original = sphere();
  const std::set<Rational3> vertices = vertices_of(original);
  double last = 0;
  for (const std::size_t triangles : {200U, 100U, 40U, 12U}) {
    const DecimatedMesh decimated = decimate(original, triangles);
    CHECK(decimated.mesh.face_count() <= triangles);
    CHECK(decimated.mesh.face_count() + 2 > triangles);
    CHECK(decimated.notes.empty());
    CHECK(std::all_of(decimated.mesh.vertices.begin(), decimated.mesh.vertices.end(),
                      [&](const Rational3& p) { return vertices.count(p) == 1; }));
    const Polyhedron smaller = from_mesh(decimated.mesh);
    // Vertices of a convex body span less than it.
    CHECK(is_subset(smaller, original));
    CHECK(decimated.distance.low > last);
    CHECK(decimated.distance.high <= 1.011 * decimated.distance.low);
    last = decimated.distance.low;
  }
}

TEST_CASE("What cannot lose a triangle keeps them all, and says so") {
  const DecimatedMesh tetrahedron =
      decimate(convex_hull(std::array<Rational3, 4>{Rational3{0, 0, 0}, Rational3{1, 0, 0}, Rational3{0, 1, 0},
                                                    Rational3{0, 0, 1}}),
               2);
  CHECK(tetrahedron.mesh.face_count() == 4);
  CHECK(tetrahedron.notes.size() == 1);
  CHECK(tetrahedron.distance.high == 0);
  const DecimatedMesh enough = decimate(make_box({0, 0, 0}, {1, 1, 1}), 50);
  CHECK(enough.mesh.face_count() == 12);
  CHECK(enough.distance.high == 0);
  CHECK(enough.notes.empty());
  CHECK_THROWS_AS(decimate(make_point({0, 0, 0}), 10), InputError);
}

TEST_CASE("Solids that share an edge or a vertex stay closed where they meet") {
  const Polyhedron ball = sphere();
  const auto bounds = bounding_box(ball).value();
  // The balls touch in a vertex or not at all.
  const AffineMap beside = AffineMap::translate({bounds[1][0] - bounds[0][0], 0, 0});
  const Polyhedron cubes = unite(make_box({10, 10, 10}, {12, 12, 12}), make_box({12, 12, 10}, {14, 14, 12}));
  const Polyhedron all = unite(unite(ball, transform(ball, beside)), cubes);
  const DecimatedMesh decimated = decimate(all, 150);
  const Polyhedron solid = from_mesh(decimated.mesh);
  CHECK(is_subset(cubes, solid));
  CHECK(counts(solid).volumes == counts(all).volumes);
}

TEST_CASE("A thin shell is not decimated until its sides cross") {
  const Polyhedron ball = sphere();
  const Polyhedron shell = subtract(
      ball, interior(transform(ball, AffineMap::scale({Rational(99) / 100, Rational(99) / 100, Rational(99) / 100}))));
  const DecimatedMesh decimated = decimate(shell, 60);
  const Polyhedron solid = from_mesh(decimated.mesh);  // legal, that is
  CHECK(counts(solid).volumes == 3);
}

}  // namespace
}  // namespace nef
