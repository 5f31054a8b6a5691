// SPDX-License-Identifier: Apache-2.0
//
// Sums at sizes where products of doubles overflow or vanish, against the scaled sum at an ordinary size.
#include "tests/support/numbers/magnitudes.h"

#include <catch2/catch.hpp>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "tests/support/shapes/machine_parts.h"
#include "tests/support/union_orders.h"

namespace nef::minkowski::magnitudes_test {
namespace {

using nef::test::kExponents;
using nef::test::power_of_two;
using nef::test::scaled;
using nef::test::turned_part;

Polyhedron sum_by(UnionStrategy strategy, const Polyhedron& a, const Polyhedron& b) {
  MinkowskiOptions options;
  options.strategy = strategy;
  return minkowski_sum(a, b, options);
}

void check_at_all_sizes(const std::vector<UnionStrategy>& strategies, const Mesh& a, const Mesh& b) {
  const Polyhedron expected =
      nef::test::united(nef::test::sums_of_cells(from_mesh(a), from_mesh(b)), nef::test::UnionOrder::kTrivial);
  for (const long exponent : kExponents) {
    const Rational factor = power_of_two(exponent);
    const Polyhedron large_a = from_mesh(scaled(a, factor));
    const Polyhedron large_b = from_mesh(scaled(b, factor));
    for (const UnionStrategy strategy : strategies) {
      INFO("times 2^" << exponent << ", strategy " << static_cast<int>(strategy));
      CHECK(equal(sum_by(strategy, large_a, large_b), scaled(expected, factor)));
    }
  }
}

TEST_CASE("sums of any magnitude: oblique pieces", "[bounds]") {
  const std::array<nef::test::ProfilePoint, 3> profile{{{1, 0}, {2, 0.1}, {1.5, 0.7}}};
  Mesh tetrahedron;
  for (const std::array<double, 3>& p :
       {std::array{0.1, 0.2, 0.3}, {1.1, 0.3, 0.2}, {0.2, 0.7, 0.1}, {0.3, 0.4, 0.9}}) {
    tetrahedron.vertices.push_back({exact_rational(p[0]), exact_rational(p[1]), exact_rational(p[2])});
  }
  for (const auto& face : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {1U, 2U, 3U}, {2U, 0U, 3U}})
    tetrahedron.push_face(face);
  check_at_all_sizes({UnionStrategy::kConvolution, UnionStrategy::kQueue}, turned_part(profile, 3, 0.3), tetrahedron);
}

TEST_CASE("sums of any magnitude: flush faces", "[bounds]") {
  const std::vector<std::array<double, 2>> corner{{0, 0}, {3, 0}, {3, 1.1}, {1, 1}, {1, 3}, {0, 3}};
  const std::vector<std::array<double, 2>> step{{0, 0}, {0.7, 0}, {0.2, 0.5}, {0, 1.3}};
  check_at_all_sizes({UnionStrategy::kConvolution, UnionStrategy::kQueue}, nef::test::extruded_part(corner, 0.3),
                     nef::test::extruded_part(step, 0.9));
}

}  // namespace
}  // namespace nef::minkowski::magnitudes_test
