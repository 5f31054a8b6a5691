// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of sets on a grid, open and closed, of mixed dimension, then sheared: the sum of two cells is a union
// of cells, and a linear map of both operands maps the sum.
#include "apps/minkowski/minkowski.h"
#include "fuzz/grid.h"

namespace nef::fuzz {
namespace {

AffineMap random_shear(Choices& choices) {
  AffineMap map = AffineMap::identity();
  if (choices.below(2) == 0) return map;
  map.linear[0][1] = Rational(choices.between(-2, 2), 3);
  map.linear[1][2] = Rational(choices.between(-2, 2), 2);
  map.linear[2][0] = choices.between(0, 1);
  for (auto& row : map.linear) {
    for (Rational& x : row) x.canonicalize();
  }
  return map.determinant() == 0 ? AffineMap::identity() : map;
}

}  // namespace

void fuzz_sums(const Case& the_case) {
  Choices& choices = the_case.choices();
  GridPolyhedron a = random_grid_set(choices, 3, false);
  GridPolyhedron b = random_grid_set(choices, 2, false);
  label_some_sets(choices, a);
  label_some_sets(choices, b);
  const AffineMap map = random_shear(choices);
  minkowski::MinkowskiOptions options;
  options.strategy = static_cast<minkowski::UnionStrategy>(choices.below(3));
  the_case.tell("a = " + a.text);
  the_case.tell("b = " + b.text);
  const Polyhedron sum =
      the_case.valid(minkowski::minkowski_sum(transform(a.set, map), transform(b.set, map), options), "sum");
  const GridSet truth = GridSet::sum(a.cells, b.cells);
  std::uint64_t points = 0;
  truth.for_each([&](const GridCell& c) {
    ++points;
    const Rational3 p = map(point_of(c));
    if (contains(sum, p) == truth.holds(c)) return;
    Case::require(false, "membership: of point(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) +
                             "), want " + (truth.holds(c) ? "inside" : "outside"));
  });
  the_case.count("points", points);
}

}  // namespace nef::fuzz
