// SPDX-License-Identifier: Apache-2.0
//
// Sums of a solid with sheets, curves and points by their convolution, against sums of cells and against the
// definition: x is in A + B iff A meets x - B.
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/distance/intersects.h"
#include "tests/support/literals.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/shapes/random_polyhedra.h"
#include "tests/support/sums_two_ways.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiReport;
using nef::test::by_cells;
using nef::test::check;
using nef::test::convolution;
using nef::test::recipes;
using nef::test::set;

const std::vector<std::string>& thin_sets() {
  static const std::vector<std::string> sets = {
      "polygon(0,0,0, 4,0,1, 4,4,0) + polygon(0,0,0, 4,4,0, 0,4,1)",                                   // a fold
      "polygon(0,0,0, 4,0,0, 4,4,0, 0,4,0) - polygon(1,1,0, 3,1,0, 3,2,0, 2,2,0, 2,3,0, 1,3,0)",       // with a hole
      "polygon(0,0,0, 3,0,0, 0,3,0) + polygon(0,0,0, 3,0,0, 0,0,3) + polygon(0,0,0, 3,0,0, 0,-3,-1)",  // three at an
                                                                                                       // edge
      "boundary(box(0,0,0, 4,3,2))",                                                                   // closed
      "boundary(box(0,0,0, 4,3,2)) + polygon(0,0,1, 4,0,1, 4,3,1, 0,3,1)",      // and a wall in it
      "segment(0,0,0, 3,1,2) + segment(3,1,2, 0,2,5) + segment(3,1,2, 4,4,4)",  // curves
      "point(0,0,0) + point(3,1,1) + segment(0,2,0, 0,2,3)",                    // points
      "box(0,0,0, 2,2,2) + polygon(2,0,1, 5,0,1, 5,2,2, 2,2,2) + segment(0,0,2, 0,0,5) + point(7,7,7)",   // all of them
      "polygon(0,0,0, 1,0,0, 1,1,0) + polygon(0,0,0, -1,0,0, -1,-1,0) + polygon(0,0,0, 0,1,1, 0,-1,1)"};  // at a point
  return sets;
}

TEST_CASE("sheets: sums with solids are those of cells, for sheets, curves, points and what consists of all") {
  const std::vector<std::string> solids = {
      "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "hull(-1,0,0, 1,0,0, 0,-1,0, 0,1,0, 0,0,-1, 0,0,1)",
      "regularize(box(0,0,0, 3,3,1) - box(1,1,0, 2,2,1))",
      "regularize(box(0,0,0, 2,2,2) - hull(1,1,1, 2,1,1, 1,2,1, 2,2,1, 1,1,3, 2,2,3))"};
  for (const std::string& thin : thin_sets()) {
    const Polyhedron a = closure(set(thin));
    for (const std::string& solid : solids) {
      CAPTURE(thin, solid);
      const Polyhedron sum = convolution(a, set(solid));
      CHECK(nef::equal(sum, by_cells(a, set(solid))));
      CHECK(nef::equal(sum, convolution(set(solid), a)));
    }
  }
}

// What has a facet twice, with half-circles of normals at its borders: a square thickened by a cube is a box, by a
// double pyramid what the hull of its corners' sums is.
TEST_CASE("sheets: a square thickened is a hull") {
  const Polyhedron square = set("polygon(0,0,0, 4,0,0, 4,3,0, 0,3,0) + polygon(4,0,0, 4,3,0, 8,3,0, 8,0,0)");
  CHECK(nef::equal(convolution(square, set("box(-1,-1,-1, 1,1,1)")), set("box(-1,-1,-1, 9,4,1)")));
  const Polyhedron bent = set("polygon(0,0,0, 4,0,0, 4,3,0, 0,3,0) + polygon(4,0,0, 4,3,0, 4,3,4, 4,0,4)");
  CHECK(nef::equal(convolution(bent, set("box(-1,-1,-1, 1,1,1)")), set("box(-1,-1,-1, 5,4,1) + box(3,-1,-1, 5,4,5)")));
}

TEST_CASE("sheets: closed sets of all dimensions on a grid, and turned") {
  check("sheets on a grid", 150, [] {
    const Polyhedron a = closure((*recipes(true, 4)).make());
    const Polyhedron b = regularize((*recipes(true, 3, 2)).make());
    RC_PRE(!a.is_empty() && !b.is_empty());
    RC_ASSERT(nef::equal(convolution(a, b), by_cells(a, b)));
  });
  nef::AffineMap turn = nef::AffineMap::identity();
  turn.linear = {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}};
  nef::AffineMap nearly = turn;
  nearly.linear[0][1] += Rational(1, 3) / Rational(nef::Integer(1) << 60U);
  check("sheets turned", 100, [&] {
    const Polyhedron a = transform(closure((*recipes(true, 4)).make()), turn);
    const Polyhedron b = transform(regularize((*recipes(true, 3, 2)).make()), nearly);
    RC_PRE(!a.is_empty() && !b.is_empty());
    RC_ASSERT(nef::equal(convolution(a, b), by_cells(a, b)));
  });
}

TEST_CASE("sheets: a point is in the sum iff the sheet meets the solid, turned about it") {
  check("sheets by the definition", 60, [] {
    const Polyhedron a = closure((*recipes(true, 4)).make());
    const Polyhedron b = regularize((*recipes(true, 3, 2)).make());
    RC_PRE(!a.is_empty() && !b.is_empty());
    const Polyhedron sum = convolution(a, b);
    const Polyhedron turned = nef::minkowski::negate(b);
    for (int i = 0; i < 10; ++i) {
      const Rational3 x = *nef::test::adversarial_points();
      RC_ASSERT(contains(sum, x) == !intersect(a, nef::test::moved(turned, x)).is_empty());
    }
  });
}

// Sheets that lack something of their border have cells.
TEST_CASE("sheets: what is not closed is left to cells") {
  const Polyhedron open =
      set("polygon(0,0,0, 4,0,0, 4,3,0, 0,3,0) + polygon(4,0,0, 4,3,0, 4,3,4, 4,0,4) - point(0,0,0)");
  MinkowskiReport report;
  const Polyhedron sum = minkowski_sum(open, set("box(-1,-1,-1, 1,1,1)"), {}, &report);
  CHECK(report.choices.back().chosen == "queue");
  CHECK_FALSE(contains(sum, {-1, -1, -1}));
}

}  // namespace
