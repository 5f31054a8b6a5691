// SPDX-License-Identifier: Apache-2.0
//
// Who blocks whom, against sums of convex pieces: a part overlaps another one when it is moved by the inside of a hull
// of differences of vertices. For solids on a small grid, which touch in every way, and turned ones.
#include "apps/planner/assembly/blocking.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/minkowski/minkowski.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// The vectors that move a onto b: the inside of the half-spaces normal * x <= offset.
struct Body {
  std::vector<std::pair<Rational3, Rational>> faces;
};

std::vector<Body> bodies_of(const Polyhedron& a, const Polyhedron& b) {
  std::vector<Body> bodies;
  for (const minkowski::ConvexCell& p : minkowski::decompose(a)) {
    for (const minkowski::ConvexCell& q : minkowski::decompose(b)) {
      if (p.dimension != 3 || q.dimension != 3) continue;
      std::vector<Rational3> differences;
      for (const Rational3& x : p.mesh.vertices) {
        for (const Rational3& y : q.mesh.vertices) differences.push_back(minus(y, x));
      }
      const Mesh mesh = minkowski::hull_cell(differences).mesh;
      Body& body = bodies.emplace_back();
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto ring = mesh.face(f);
        const Rational3& corner = mesh.vertices[ring[0]];
        const Rational3 normal = cross(minus(mesh.vertices[ring[1]], corner), minus(mesh.vertices[ring[2]], corner));
        body.faces.emplace_back(normal, dot(normal, corner));
      }
    }
  }
  return bodies;
}

bool holds_origin(const Body& body) {
  return std::all_of(body.faces.begin(), body.faces.end(), [](const auto& face) { return face.second > 0; });
}

bool meets_start(const Body& body, const Rational3& d) {
  return std::all_of(body.faces.begin(), body.faces.end(), [&d](const auto& face) {
    return face.second > 0 || (face.second == 0 && dot(face.first, d) < 0);
  });
}

bool meets_ray(const Body& body, const Rational3& d) {
  Rational low = 0;
  std::optional<Rational> high;
  for (const auto& [normal, offset] : body.faces) {
    const Rational slope = dot(normal, d);
    if (slope == 0) {
      if (offset <= 0) return false;
      continue;
    }
    const Rational t = offset / slope;
    if (slope < 0) {
      low = std::max(low, t);
    } else if (!high || t < *high) {
      high = t;
    }
  }
  return !high || low < *high;
}

template <class Ask>
bool any(const std::vector<Body>& bodies, const Ask& ask) {
  return std::any_of(bodies.begin(), bodies.end(), ask);
}

// Hulls of points of a grid, cut out of each other or united.
Polyhedron grid_solid(std::mt19937& random) {
  const auto hull = [&] {
    while (true) {
      std::vector<Rational3> points;
      for (unsigned i = 0; i < 4 + random() % 4; ++i) {
        points.push_back({Rational(random() % 4), Rational(random() % 4), Rational(random() % 4)});
      }
      Polyhedron result = minkowski::to_polyhedron(minkowski::hull_cell(points));
      if (!interior(result).is_empty()) return result;
    }
  };
  Polyhedron result = hull();
  for (unsigned i = random() % 3; i > 0; --i) {
    const Polyhedron more = hull();
    const Polyhedron next = regularize(random() % 2 == 0 ? unite(result, more) : subtract(result, more));
    if (!next.is_empty()) result = next;
  }
  return closure(result);
}

// Cubes of a lattice, as puzzles are made of.
Polyhedron lattice_solid(std::mt19937& random) {
  std::vector<Polyhedron> cubes;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 2; ++y) {
      for (int z = 0; z < 2; ++z) {
        if (random() % 2 == 0) cubes.push_back(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
      }
    }
  }
  if (cubes.empty()) cubes.push_back(make_box({0, 0, 0}, {1, 1, 1}));
  return unite_all(cubes);
}

void compare_all(const Polyhedron& a, const Polyhedron& b, std::mt19937& random, std::array<std::size_t, 4>& seen) {
  const std::vector<Body> bodies = bodies_of(a, b);
  Blocking blocking({a, b}, {});
  const bool overlap = any(bodies, holds_origin);
  CHECK(blocking.overlapping().has_value() == overlap);
  ++seen[overlap ? 0 : 1];
  if (overlap) return;
  CHECK(blocking.contact(0, 1)->point.has_value() == !intersect(a, b).is_empty());
  if (blocking.contact(0, 1)->point) {
    const Rational3& point = *blocking.contact(0, 1)->point;
    CHECK((contains(a, point) && contains(b, point)));
  }
  for (int i = 0; i < 60; ++i) {
    Rational3 d;
    const int range = i < 30 ? 1 : 5;
    for (Rational& x : d) x = static_cast<int>(random() % static_cast<unsigned>(2 * range + 1)) - range;
    if (d == Rational3{}) continue;
    const Rational3 back{-d[0], -d[1], -d[2]};
    const bool starts = any(bodies, [&](const Body& body) { return meets_start(body, d); });
    const bool hits = any(bodies, [&](const Body& body) { return meets_ray(body, d); });
    CHECK(blocking.blocks_at_once(0, 1, d) == starts);
    CHECK(blocking.blocks_at_once(1, 0, back) == starts);
    CHECK(blocking.blocks(0, 1, d) == hits);
    CHECK(blocking.blocks(1, 0, back) == hits);
    seen[2] += starts ? 1 : 0;
    seen[3] += hits ? 1 : 0;
  }
}

TEST_CASE("blocking: as sums of convex pieces say, for solids on a grid") {
  std::mt19937 random(3);
  std::array<std::size_t, 4> seen{};
  for (unsigned k = 0; k < seeds(40); ++k) {
    const bool lattice = k % 2 == 0;
    Polyhedron a = lattice ? lattice_solid(random) : grid_solid(random);
    Polyhedron b = lattice ? lattice_solid(random) : grid_solid(random);
    // Next to each other, or one in the other's bounds without what both have.
    Rational3 by;
    for (Rational& x : by) x = static_cast<int>(random() % 5) - 2;
    if (k % 4 < 2) {
      b = transform(b, AffineMap::translate(by));
    } else {
      b = closure(regularize(subtract(b, a)));
      if (b.is_empty()) continue;
    }
    if (k % 3 == 0) {
      const AffineMap turn = oblique_rotation();
      a = transform(a, turn);
      b = transform(b, turn);
    }
    INFO("case " << k);
    compare_all(a, b, random, seen);
  }
  CHECK(seen[0] > 0);
  CHECK(seen[1] > nef::test::fewer(10));
  CHECK(seen[2] > nef::test::fewer(100));
  CHECK(seen[3] > seen[2]);
}

TEST_CASE("blocking: far from the origin, and at extreme magnitudes") {
  for (const char* scale :
       {"1", "1/100000000000000000000000000000000000000000", "1000000000000000000000000000000000000"}) {
    std::mt19937 random(5);
    std::array<std::size_t, 4> seen{};
    const Rational s(scale);
    AffineMap map = AffineMap::identity();
    for (std::size_t i = 0; i < 3; ++i) {
      map.linear[i][i] = s;
      map.translation[i] = s * 1000000007;
    }
    for (int k = 0; k < 3; ++k) {
      const Polyhedron a = grid_solid(random);
      const Polyhedron b = closure(regularize(subtract(make_box({-1, -1, -1}, {3, 3, 3}), a)));
      compare_all(transform(a, map), transform(b, map), random, seen);
    }
    CHECK(seen[2] > 0);
  }
}

}  // namespace
}  // namespace nef::planner::test
