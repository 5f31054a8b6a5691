// SPDX-License-Identifier: Apache-2.0
//
// The filters of meshes against rational arithmetic, where their errors are worst.
#include <catch2/catch.hpp>
#include <numeric>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh_points.h"
#include "tests/support/worst_error.h"

namespace nef::test {

TEST_CASE("determinants of mesh points: the bound holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const double found = worst(bits, 13, bits, [](const Genes& g) {
      std::array<Rational3, 4> p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = point_of_genes(g, 3 * i, 12);
      const MeshPoints points(p);
      const Approximation rough = points.determinant(0, 1, 2, 3);
      const Rational truth = dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
      return part_of(exact_rational(rough.value) - truth, rough.error);
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 64);
  }
}

TEST_CASE("margins of mesh points hold where the error is worst", "[bounds]") {
  const double found = worst(3, 4, 62, [](const Genes& g) {
    const std::array<Rational3, 2> p{point_of_genes(g, 0, 3), Rational3{1, 1, 1}};
    const MeshPoints points(p);
    double part = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      part = std::max(part, part_of(exact_rational(points.approximate(0)[i]) - p[0][i], points.margin(i)));
    }
    return part;
  });
  INFO(found);
  CHECK(found <= 1);
  CHECK(found > 1.0 / 16);
}

}  // namespace nef::test
