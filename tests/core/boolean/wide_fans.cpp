// SPDX-License-Identifier: Apache-2.0
//
// Vertices of high degree: what is left out there meets in the vertex only, and pairs of neighbours are all that is
// left. Random cases stand in fuzz/fuzzers/sets/stars.cpp.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "nef/construct/construct.h"
#include "nef/geometry/search/direction_tree.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_patches.h"
#include "nef/polyhedron.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Rational thousandths(double x) { return {std::lround(1000 * x), 1000}; }

// A cone with its apex at the origin over a star-shaped polygon in the plane z = -1000, or with a second apex below.
Mesh cone(int sides, bool doubled, const std::array<int, 2>& radii, int shift) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * 3.14159265358979 * (i + 0.3 * (shift != 0 ? 1 : 0)) / sides;
    const double r = radii[static_cast<std::size_t>(i % 2)];
    mesh.vertices.push_back({thousandths(r * std::cos(a)) + shift, thousandths(r * std::sin(a)), -1000});
  }
  mesh.vertices.push_back({0, 0, 0});
  mesh.vertices.push_back({shift, 0, doubled ? -2000 : -1000});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.push_face(std::array{i, j, n});
    mesh.push_face(std::array{j, i, n + 1});
  }
  return mesh;
}

std::set<Pair> candidates(const Mesh& mesh) {
  const MeshSurface surface(mesh, {});
  std::set<Pair> found;
  SurfacePatches(surface, {}).for_each_candidate([&](std::uint32_t t, std::uint32_t u) { found.insert({t, u}); });
  return found;
}

// Where triangle u meets triangle t: corners of the intersection, which is convex, by cutting u with the planes that
// bound t.
std::vector<Rational3> meeting(const std::array<Rational3, 3>& t, const std::array<Rational3, 3>& u) {
  const Rational3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  std::vector<std::pair<Rational3, Rational3>> half_spaces{{normal, t[0]},
                                                           {Rational3{-normal[0], -normal[1], -normal[2]}, t[0]}};
  for (std::size_t i = 0; i < 3; ++i) half_spaces.emplace_back(cross(normal, minus(t[(i + 1) % 3], t[i])), t[i]);
  std::vector<Rational3> polygon(u.begin(), u.end());
  for (const auto& [n, at] : half_spaces) {
    std::vector<Rational3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Rational3& p = polygon[i];
      const Rational3& q = polygon[(i + 1) % polygon.size()];
      const Rational of_p = dot(n, minus(p, at));
      const Rational of_q = dot(n, minus(q, at));
      if (of_p >= 0) kept.push_back(p);
      if (of_p * of_q >= 0) continue;
      const Rational s = of_p / (of_p - of_q);
      const Rational3 d = minus(q, p);
      kept.push_back({p[0] + s * d[0], p[1] + s * d[1], p[2] + s * d[2]});
    }
    polygon = std::move(kept);
  }
  return polygon;
}

// True if two triangles have in common more than corners and edges that both name.
bool meet_beyond(const Mesh& mesh, std::uint32_t t, std::uint32_t u) {
  std::array<std::array<Rational3, 3>, 2> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[0][k] = mesh.vertices[mesh.face(t)[k]];
    corners[1][k] = mesh.vertices[mesh.face(u)[k]];
  }
  std::vector<Rational3> shared;
  for (const Rational3& p : corners[0]) {
    if (std::find(corners[1].begin(), corners[1].end(), p) != corners[1].end()) shared.push_back(p);
  }
  for (const Rational3& p : meeting(corners[0], corners[1])) {
    if (shared.size() == 2 && is_zero(cross(minus(shared[1], shared[0]), minus(p, shared[0])))) continue;
    if (shared.size() == 3 || std::find(shared.begin(), shared.end(), p) == shared.end()) return true;
  }
  return false;
}

Mesh together(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (std::size_t f = 0; f < b.face_count(); ++f) {
    std::vector<std::uint32_t> ring;
    for (const std::uint32_t v : b.face(f)) ring.push_back(first + v);
    mesh.push_face(ring);
  }
  return mesh;
}

}  // namespace

TEST_CASE("Triangles with a common point are seen in a common direction", "[wide fans]") {
  std::mt19937 random(5);
  const auto number = [&](int size) { return static_cast<double>(static_cast<int>(random() % (2 * size + 1)) - size); };
  std::size_t told = 0;
  for (int round = 0; round < 20000; ++round) {
    const Double3 centre{number(8), number(8), number(8)};
    const int size = round % 3 == 0 ? 4 : 1000;
    std::array<Double3, 3> t;
    for (Double3& p : t) p = {number(size), number(size), number(size)};
    // A point of t, exactly, as one end of a segment or the middle of one, seen from the centre in the same direction.
    const double i = static_cast<double>(random() % 5) / 4;
    const double j = (1 - i) * static_cast<double>(random() % 5) / 4;
    const double scale = std::array{1.0, 0.5, 2.0}[random() % 3];
    Double3 x;
    Double3 d;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = centre[k] + scale * (t[0][k] + i * (t[1][k] - t[0][k]) + j * (t[2][k] - t[0][k]) - centre[k]);
      d[k] = number(size);
    }
    const std::array<Double3, 2> segment{Double3{x[0] - d[0], x[1] - d[1], x[2] - d[2]},
                                         random() % 2 == 0 ? x : Double3{x[0] + d[0], x[1] + d[1], x[2] + d[2]}};
    DirectionTree tree(centre, 0);
    const bool added = tree.add(7, std::span<const Double3>(t).first(round % 2 == 0 ? 3 : 2));
    tree.build();
    if (round % 2 != 0 && j != 0) continue;  // x is not on the side
    std::vector<std::uint32_t> found;
    if (!added || !tree.find(segment, found)) continue;
    CAPTURE(round);
    REQUIRE(!found.empty());
    ++told;
  }
  CHECK(told > 5000);
}

TEST_CASE("Faces around a vertex of high degree meet where all pairs of them do", "[wide fans]") {
  for (const bool doubled : {false, true}) {
    for (const auto& radii : {std::array{1000, 1000}, std::array{1000, 400}}) {
      for (const int shift : {0, 300}) {
        CAPTURE(doubled, radii, shift);
        Mesh mesh = cone(70, doubled, radii, shift);
        // Another cone with the same apex crosses it, and a triangle goes through its apex.
        mesh = together(mesh, cone(66, !doubled, {900, 500}, 120));
        mesh.vertices.insert(mesh.vertices.end(), {{-100, 0, 50}, {100, 0, 50}, {0, 0, -70}});
        const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.push_face(std::array{last - 3, last - 2, last - 1});
        const MeshSurface surface(mesh, {});
        REQUIRE(surface.triangles.size() == mesh.face_count());
        const std::set<Pair> found = candidates(mesh);
        std::size_t meeting = 0;
        const std::uint32_t step = 15 / test::fewer(5);  // every third pair
        for (std::uint32_t t = 0; t < mesh.face_count(); ++t) {
          for (std::uint32_t u = t + 1; u < mesh.face_count(); u += step) {
            if (!meet_beyond(mesh, t, u)) continue;
            ++meeting;
            REQUIRE(found.count({t, u}) == 1);
          }
        }
        CHECK(meeting > test::fewer(40));
      }
    }
  }
}

TEST_CASE("The pairs that are looked at around a vertex of high degree grow with the degree", "[wide fans]") {
  for (const bool doubled : {false, true}) {
    for (const auto& radii : {std::array{1000, 1000}, std::array{1000, 400}}) {
      CAPTURE(doubled, radii);
      CHECK(candidates(cone(2000, doubled, radii, 0)).size() < 20 * 2000);
    }
  }
}

TEST_CASE("Unions and differences of cones of many sides with one apex", "[wide fans]") {
  for (const bool doubled : {false, true}) {
    const Mesh first = cone(150, doubled, {1000, 600}, 0);
    const Mesh second = cone(130, !doubled, {900, 900}, 250);
    const Polyhedron a = from_mesh(first);
    const Polyhedron b = from_mesh(second);
    const Polyhedron united = unite(a, b);
    const Polyhedron common = intersect(a, b);
    const Polyhedron left = subtract(a, b);
    CHECK(*volume(united) + *volume(common) == *volume(a) + *volume(b));
    CHECK(*volume(left) + *volume(common) == *volume(a));
    CHECK(*volume(common) > 0);
    CHECK(equal(unite(left, common), a));
    CHECK(equal(a, from_mesh(first)));
    CHECK_FALSE(equal(a, b));
  }
}

TEST_CASE("Predicates of a union of cones with one apex grow with their sides", "[wide fans]") {
  const auto signs = [](int sides) {
    const Polyhedron a = from_mesh(cone(sides, true, {1000, 1000}, 0));
    const Polyhedron b = from_mesh(cone(sides, true, {1000, 1000}, 500));
    PredicateCounts counts;
    static_cast<void>(unite(a, b, Monitor().counting(counts)));
    return counts.identity + counts.filter + counts.exact;
  };
  CHECK(signs(1600) < 6 * signs(400));
}

}  // namespace nef
