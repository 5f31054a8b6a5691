// SPDX-License-Identifier: Apache-2.0
//
// Sums and what is made of them take sets with labels for their points whose label is not 0.
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/construct/construct.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/labeled.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace nef::minkowski {
namespace {

using test::labeled;
using test::recipes;
using test::valid;

Polyhedron united_cells(const Polyhedron& a) {
  std::vector<Polyhedron> cells;
  for (const ConvexCell& cell : decompose(a)) cells.push_back(to_polyhedron(cell));
  return unite_all(cells);
}

TEST_CASE("labels: sums, erosions, cells and hulls") {
  test::check("labels", 60, [] {
    const Polyhedron a = (*recipes(true, 3)).make();
    const Polyhedron b = (*recipes(true, 2, 2)).make();
    const Polyhedron with_a = labeled(a, b);
    const Polyhedron with_b = labeled(b, a);
    for (const auto& strategy : kUnionStrategies) {
      RC_ASSERT(equal(valid(minkowski_sum(with_a, with_b, {strategy.second, {}}), "sum"), minkowski_sum(a, b)));
    }
    RC_ASSERT(equal(valid(erode(with_a, with_b), "erosion"), erode(a, b)));
    RC_ASSERT(equal(no_fit_set(with_a, with_b), no_fit_set(a, b)));
    RC_ASSERT(equal(offset(with_a, 0, 1, Side::kOuter), a));
    RC_ASSERT(equal(hull(with_a), hull(a)));
    RC_ASSERT(equal(united_cells(with_a), a));
    RC_ASSERT(is_convex(with_a) == is_convex(a));
    if (a.is_empty() || b.is_empty()) return;
    RC_ASSERT(equal(configuration_space(with_b, std::vector{with_a}), configuration_space(b, std::vector{a})));
    const Penetration with = penetration(with_a, with_b);
    const Penetration without = penetration(a, b);
    RC_ASSERT(with.kind == without.kind);
    RC_ASSERT(with.squared_length == without.squared_length);
  });
}

TEST_CASE("labels: unbounded sets") {
  const Polyhedron above = make_halfspace(0, 0, -1, 0, true);
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, 2});
  const Polyhedron with = labeled(above, box);
  CHECK(equal(minkowski_sum(with, box), minkowski_sum(above, box)));
  CHECK(equal(hull(with), above));
  CHECK(equal(erode(with, labeled(box, above)), erode(above, box)));
}

}  // namespace
}  // namespace nef::minkowski
