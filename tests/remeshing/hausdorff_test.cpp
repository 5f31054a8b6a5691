// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/hausdorff.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/distance/distance.h"
#include "nef/polyhedron.h"
#include "tests/support/numbers/magnitudes.h"

namespace nef {
namespace {

void add_triangle(Mesh& mesh, const Rational3& a, const Rational3& b, const Rational3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.push_face(std::array<std::uint32_t, 3>{first, first + 1, first + 2});
}

// The square [0, side]^2 at a height, cut along one diagonal or the other.
Mesh square(long side, long height, bool other_diagonal) {
  Mesh mesh;
  const Rational3 a{0, 0, height};
  const Rational3 b{side, 0, height};
  const Rational3 c{side, side, height};
  const Rational3 d{0, side, height};
  if (other_diagonal) {
    add_triangle(mesh, a, b, d);
    add_triangle(mesh, b, c, d);
  } else {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
  }
  return mesh;
}

constexpr std::size_t kSplits = 20000;

void check_bounds(const DistanceBounds& bounds, double truth) {
  CHECK(bounds.low <= truth);
  CHECK(bounds.high >= truth);
  CHECK(bounds.low >= truth * 0.989);
  CHECK(bounds.high <= truth * 1.011);
}

TEST_CASE("Hausdorff distances that are known") {
  check_bounds(hausdorff_distance(square(10, 0, false), square(10, 3, true), kSplits), 3);
  // A corner of the larger square is farthest from the smaller one, whichever comes first.
  check_bounds(hausdorff_distance(square(10, 0, false), square(6, 0, false), kSplits), std::sqrt(32.0));
  check_bounds(hausdorff_distance(square(6, 0, false), square(10, 0, false), kSplits), std::sqrt(32.0));
  // Far from the origin only what doubles hold is lost.
  const DistanceBounds far = hausdorff_distance(square(10, 1L << 40, false), square(10, (1L << 40) + 3, true), kSplits);
  CHECK(far.low <= 3);
  CHECK(far.high >= 3);
  CHECK(far.high - far.low < 0.1);
}

TEST_CASE("The distance may be largest between vertices") {
  Mesh bridge;
  add_triangle(bridge, {-10, 0, 0}, {10, 0, 0}, {10, 1, 0});
  Mesh banks;
  add_triangle(banks, {-10, 0, 0}, {-10, 1, 0}, {-12, 0, 0});
  add_triangle(banks, {10, 0, 0}, {10, 1, 0}, {12, 0, 0});
  // All vertices of the bridge are on a bank, and its middle is 10 from both.
  check_bounds(hausdorff_distance(bridge, banks, kSplits), 10);
}

TEST_CASE("The same surface cut otherwise is at no distance that could be told from zero") {
  const DistanceBounds bounds = hausdorff_distance(square(8, 0, false), square(8, 0, true), kSplits);
  CHECK(bounds.low == 0);
  CHECK(bounds.high < 0.05);
}

TEST_CASE("No point of random surfaces is farther from the other than the upper bound: exact distances of samples") {
  std::mt19937 random(3);
  std::uniform_int_distribution<long> coordinate(-50, 50);
  const auto soup = [&] {
    Mesh mesh;
    for (int i = 0; i < 6; ++i) {
      const auto point = [&] { return Rational3{coordinate(random), coordinate(random), coordinate(random)}; };
      add_triangle(mesh, point(), point(), point());
    }
    return mesh;
  };
  for (int round = 0; round < 8; ++round) {
    const Mesh a = soup();
    const Mesh b = soup();
    const DistanceBounds bounds = hausdorff_distance(a, b, kSplits);
    MeshOptions as_surface;
    as_surface.as_surface = true;
    const std::array<Polyhedron, 2> sets{from_mesh(a, as_surface), from_mesh(b, as_surface)};
    double farthest = 0;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const Mesh& mesh = side == 0 ? a : b;
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        for (long u = 0; u <= 4; ++u) {
          for (long v = 0; u + v <= 4; ++v) {
            Rational3 p;
            for (std::size_t i = 0; i < 3; ++i) {
              p[i] = (mesh.vertices[3 * f][i] * (4 - u - v) + mesh.vertices[3 * f + 1][i] * u +
                      mesh.vertices[3 * f + 2][i] * v) /
                     4;
            }
            const Rational squared = distance(make_point(p), sets[1 - side])->squared;
            CHECK(Rational(bounds.high) * Rational(bounds.high) >= squared);
            farthest = std::max(farthest, std::sqrt(squared.get_d()));
          }
        }
      }
    }
    CHECK(bounds.high <= 1.011 * bounds.low);
    // Samples are at most a quarter of a side away from any point, so that the lower bound can be told from too much.
    CHECK(bounds.low <= farthest + 45);
  }
}

// Two squares of side 4 and 1 at heights 0 and 1: a corner of the large one is sqrt(9 + 9 + 1) from the small one.
TEST_CASE("Squares of any magnitude", "[bounds]") {
  const Mesh large = square(4, 0, false);
  const Mesh small = square(1, 1, true);
  for (const long exponent : test::kExponents) {
    INFO("times 2^" << exponent);
    const Rational factor = test::power_of_two(exponent);
    const DistanceBounds bounds = hausdorff_distance(test::scaled(large, factor), test::scaled(small, factor), kSplits);
    const Rational squared = 19 * factor * factor;
    CHECK(exact_rational(bounds.low) * exact_rational(bounds.low) <= squared);
    if (std::isinf(bounds.high)) {
      CHECK(exponent > 1020);
      continue;
    }
    CHECK(exact_rational(bounds.high) * exact_rational(bounds.high) >= squared);
    if (std::labs(exponent) <= 1020) CHECK(bounds.high <= 1.011 * bounds.low);
  }
}

TEST_CASE("Only triangles, and at least one") {
  CHECK_THROWS_AS(hausdorff_distance(Mesh{}, square(1, 0, false), 10), InputError);
  Mesh quad;
  quad.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  quad.push_face(std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK_THROWS_AS(hausdorff_distance(quad, square(1, 0, false), 10), InputError);
}

}  // namespace
}  // namespace nef
