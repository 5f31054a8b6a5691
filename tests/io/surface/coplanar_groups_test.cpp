// SPDX-License-Identifier: Apache-2.0
//
// Meshes with so many coplanar faces around a vertex that the check unites them. The truth is known from the
// construction: a fan over a convex polygon has no contacts iff its apex lies inside; elsewhere it covers what lies
// beyond the polygon once from each side, which leaves the lid as it is.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "nef/construct/construct.h"
#include "nef/mesh/mesh_check.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Ring = std::vector<std::uint32_t>;

// A convex polygon with integer coordinates at the height z.
Ring add_ring(Mesh& mesh, std::uint32_t sides, double radius, long z) {
  Ring ring;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    ring.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)), Rational(z)});
  }
  return ring;
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.push_face(std::array<std::uint32_t, 3>{a, b, c});
}

// Triangles between two rings of the same size, with the lower one counterclockwise as seen from above.
void add_band(Mesh& mesh, const Ring& low, const Ring& high) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    const std::size_t j = (i + 1) % low.size();
    add_triangle(mesh, low[i], low[j], high[j]);
    add_triangle(mesh, low[i], high[j], high[i]);
  }
}

void add_fan(Mesh& mesh, const Ring& ring, const Rational3& apex, bool upward) {
  const auto centre = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(apex);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t a = ring[i];
    const std::uint32_t b = ring[(i + 1) % ring.size()];
    upward ? add_triangle(mesh, a, b, centre) : add_triangle(mesh, b, a, centre);
  }
}

constexpr double kRadius = 1e6;
constexpr long kHeight = 1000;

Mesh drum(std::uint32_t sides, const Rational& apex_x) {
  Mesh mesh;
  const Ring low = add_ring(mesh, sides, kRadius, 0);
  const Ring high = add_ring(mesh, sides, kRadius, kHeight);
  add_band(mesh, low, high);
  add_fan(mesh, low, {0, 0, 0}, false);
  add_fan(mesh, high, {apex_x, Rational(7), Rational(kHeight)}, true);
  return mesh;
}

// A tetrahedron on its tip.
void add_needle(Mesh& mesh, const Rational& x, const Rational& y, const Rational& tip) {
  const auto v = static_cast<std::uint32_t>(mesh.vertices.size());
  const Rational top = tip + 5000;
  for (const Rational3& p :
       std::vector<Rational3>{{x, y, tip}, {x + 10, y, top}, {x, y + 10, top}, {x - 10, y - 10, top}}) {
    mesh.vertices.push_back(p);
  }
  add_triangle(mesh, v, v + 2, v + 1);
  add_triangle(mesh, v, v + 3, v + 2);
  add_triangle(mesh, v, v + 1, v + 3);
  add_triangle(mesh, v + 1, v + 2, v + 3);
}

std::size_t count(const Mesh& mesh, MeshProblemKind kind) {
  std::size_t result = 0;
  for (const MeshProblem& problem : check_mesh(mesh)) result += problem.kind == kind ? 1 : 0;
  return result;
}

}  // namespace

TEST_CASE("A drum with fans for lids is free of contacts iff their apexes lie inside, and the same drum otherwise") {
  for (const std::uint32_t sides : {12U, 400U}) {
    CAPTURE(sides);
    for (const long x : {0L, 900000L, -990000L}) CHECK(check_mesh(drum(sides, Rational(x))).empty());
    const Polyhedron plain = from_mesh(drum(sides, 0));
    for (const long x : {1000100L, -3000000L}) {
      const Mesh folded = drum(sides, Rational(x));
      CHECK(count(folded, MeshProblemKind::kTouching) > 0);
      CHECK(count(folded, MeshProblemKind::kSelfIntersection) == 0);
      CHECK(equal(from_mesh(folded), plain));
    }
    const Counts n = counts(from_mesh(drum(sides, 900000)));
    CHECK(n.vertices == 2 * sides);
    CHECK(n.facets == sides + 2);
  }
}

TEST_CASE("Needles on, in and beside a fan of four hundred triangles") {
  const auto with_needle = [](const Rational& x, const Rational& y, const Rational& tip) {
    Mesh mesh = drum(400, 0);
    add_needle(mesh, x, y, tip);
    return mesh;
  };
  CHECK(check_mesh(with_needle(5000, 3000, kHeight + 1)).empty());
  const Mesh standing = with_needle(500000, 300000, kHeight);
  CHECK(count(standing, MeshProblemKind::kTouching) == 3);
  CHECK(count(standing, MeshProblemKind::kSelfIntersection) == 0);
  CHECK(count(with_needle(500000, 300000, kHeight - 1), MeshProblemKind::kSelfIntersection) > 0);
  CHECK(check_mesh(with_needle(1100000, 0, kHeight - 1)).empty());
  // On the corner of the fan, as a vertex of its own.
  CHECK(check_mesh(with_needle(0, 7, kHeight)).empty());
}

TEST_CASE("A washer beside a drum: what passes through the hole crosses nothing") {
  const auto scene = [](const Rational& needle_x) {
    Mesh mesh = drum(400, 0);
    constexpr double kInner = 2e6;
    constexpr double kOuter = 3e6;
    const Ring low_in = add_ring(mesh, 60, kInner, 0);
    const Ring low_out = add_ring(mesh, 60, kOuter, 0);
    const Ring high_in = add_ring(mesh, 60, kInner, kHeight);
    const Ring high_out = add_ring(mesh, 60, kOuter, kHeight);
    add_band(mesh, low_out, high_out);
    add_band(mesh, high_in, low_in);
    add_band(mesh, low_in, low_out);
    add_band(mesh, high_out, high_in);
    add_needle(mesh, needle_x, 0, -10);
    return mesh;
  };
  CHECK(check_mesh(scene(1500000)).empty());
  CHECK(check_mesh(scene(3500000)).empty());
  CHECK(count(scene(2500000), MeshProblemKind::kSelfIntersection) > 0);
}

}  // namespace nef
