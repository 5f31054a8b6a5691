// SPDX-License-Identifier: Apache-2.0
//
// Witnesses of pairs of hulls: what they say is verified by arithmetic, and which of both it is by Booleans.
#include "apps/planner/intersection/common_point.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::planner::test::common_point {
namespace {

using Points = std::vector<Rational3>;

// Few different coordinates, so that hulls are often flat, and often touch.
Points points() {
  const auto count = *rc::gen::inRange(1, 7);
  Points result;
  for (int i = 0; i < count; ++i) {
    result.push_back({*rc::gen::inRange(0, 4), *rc::gen::inRange(0, 4), *rc::gen::inRange(0, 3)});
  }
  return result;
}

Rational3 sum_of(const Points& points, const std::vector<Rational>& weights, bool positive) {
  RC_ASSERT(points.size() == weights.size());
  Rational3 sum;
  Rational all = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    RC_ASSERT((positive ? weights[i] > 0 : weights[i] >= 0));
    all += weights[i];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[i] * points[i][k];
  }
  RC_ASSERT(all == 1);
  return sum;
}

TEST_CASE("Two hulls have a common point or a plane between them, as Booleans have it", "[proofs]") {
  CHECK(rc::check([] {
    const Points a = points();
    Points b = points();
    const Rational shift = *rc::gen::inRange(0, 4);
    for (Rational3& p : b) p[0] += shift;
    const Polyhedron hull_a = convex_hull(a);
    const Polyhedron hull_b = convex_hull(b);
    const bool solid = hull_a.is_regular() && hull_b.is_regular();
    for (const bool inside : {false, true}) {
      if (inside && !solid) continue;  // relative interiors are no matter of the planner
      const HullWitness witness = witness_of_hulls(a, b, inside);
      const Polyhedron common = inside ? intersect(interior(hull_a), interior(hull_b)) : intersect(hull_a, hull_b);
      RC_ASSERT(witness.common.has_value() == !common.is_empty());
      if (witness.common) {
        RC_ASSERT(sum_of(a, witness.common->robot, inside) == sum_of(b, witness.common->obstacle, inside));
        continue;
      }
      RC_ASSERT(!is_zero(witness.normal));
      for (const Rational3& p : a) {
        for (const Rational3& q : b) {
          const Rational gap = dot(witness.normal, minus(q, p));
          RC_ASSERT((inside ? gap >= 0 : gap > 0));
        }
      }
    }
  }));
}

}  // namespace
}  // namespace nef::planner::test::common_point
