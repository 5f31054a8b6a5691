// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/decimate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/mesh/mesh_check.h"
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

// Nothing but what each mesh of a solid may have: faces meet in edges and vertices that they share.
bool is_strictly_legal(const Mesh& mesh) {
  const std::vector<MeshProblem> problems = check_mesh(mesh);
  return std::all_of(problems.begin(), problems.end(), [](const MeshProblem& problem) {
    return problem.legal && problem.kind == MeshProblemKind::kNonManifoldEdge;
  });
}

using Point = Eigen::Vector3d;

Point point_of_vertex(const Mesh& mesh, std::uint32_t v) {
  return {nearest_double(mesh.vertices[v][0]), nearest_double(mesh.vertices[v][1]),
          nearest_double(mesh.vertices[v][2])};
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * (b - a)).norm();
}

double distance_to_triangle(const Point& p, const std::array<Point, 3>& t) {
  double best = std::min(
      {distance_to_segment(p, t[0], t[1]), distance_to_segment(p, t[1], t[2]), distance_to_segment(p, t[2], t[0])});
  const Point normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (!(normal.norm() > 0)) return best;
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) inside = inside && normal.cross(t[(i + 1) % 3] - t[i]).dot(p - t[i]) >= 0;
  if (inside) best = std::min(best, std::abs((p - t[0]).dot(normal.normalized())));
  return best;
}

// The largest distance of a vertex of `from` to `to`, by brute force: no more than the Hausdorff distance.
double farthest_vertex(const Mesh& from, const Mesh& to) {
  double farthest = 0;
  for (std::uint32_t v = 0; v < from.vertices.size(); ++v) {
    const Point p = point_of_vertex(from, v);
    double nearest = INFINITY;
    for (std::size_t f = 0; f < to.face_count(); ++f) {
      const auto corners = to.face(f);
      nearest =
          std::min(nearest, distance_to_triangle(p, {point_of_vertex(to, corners[0]), point_of_vertex(to, corners[1]),
                                                     point_of_vertex(to, corners[2])}));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST_CASE("One bad place does not keep the rest from being decimated") {
  const auto check_shape = [](const Polyhedron& set, std::size_t triangles) {
    const Mesh exact = to_mesh(set).mesh;
    REQUIRE(exact.face_count() > triangles);
    const DecimatedMesh decimated = decimate(set, triangles);
    INFO(triangles << " of " << exact.face_count() << (decimated.notes.empty() ? "" : ": " + decimated.notes[0]));
    CHECK(decimated.mesh.face_count() <= triangles);
    CHECK(decimated.mesh.face_count() + 2 >= triangles);
    CHECK(decimated.notes.empty());
    CHECK(is_strictly_legal(decimated.mesh));
    CHECK_FALSE(from_mesh(decimated.mesh).is_empty());
    const double farthest = farthest_vertex(exact, decimated.mesh);
    CHECK(farthest <= decimated.distance.high * (1 + 1e-9));
    CHECK(decimated.distance.low <= decimated.distance.high);
  };
  const auto shipped = [](const std::string& name) {
    return from_mesh(read_mesh(source_folder() + "/data/meshes/" + name));
  };
  const Polyhedron rotor = shipped("rotor.off");
  for (const std::size_t triangles : {400U, 200U, 120U}) check_shape(rotor, triangles);
  for (const char* name : {"hand.off", "eight.off"}) {
    INFO(name);
    check_shape(shipped(name), 100);
  }
  // A ball with thin fins: its coarse meshes cross them.
  Polyhedron finned = sphere();
  const auto bounds = bounding_box(finned).value();
  const Rational size = bounds[1][0] - bounds[0][0];
  for (int k = 0; k < 6; ++k) {
    const Rational x = bounds[0][0] + size * (2 * k + 1) / 12;
    finned = unite(finned, make_box({x, bounds[0][1] - size / 50, bounds[0][2] - size / 50},
                                    {x + size / 200, bounds[1][1] + size / 50, bounds[1][2] + size / 50}));
  }
  check_shape(finned, 250);
}

}  // namespace
}  // namespace nef
