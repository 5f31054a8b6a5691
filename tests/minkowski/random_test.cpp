// SPDX-License-Identifier: Apache-2.0
//
// The laws on random bounded sets that are rich in coincidences: grid coordinates, open and closed
// parts, cavities, antennas, non-manifold contacts. A failure prints sets that can be pasted into a test.
#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/union/solid_union.h"
#include "nef/construct/convex_hull.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/random_polyhedra.h"
#include "tests/support/union_orders.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::ConvexCell;
using nef::minkowski::decompose;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::negate;
using nef::minkowski::UnionStrategy;
using nef::test::check;
using nef::test::hard_points;
using nef::test::moved;
using nef::test::Recipe;
using nef::test::recipes;
using nef::test::valid;

TEST_CASE("random: x is in A + B iff A meets x - B, sums commute") {
  check("membership", 300, [] {
    const Recipe ra = *recipes(true, 4);
    const Recipe rb = *recipes(true, 2, 2);
    const Polyhedron a = ra.make();
    const Polyhedron b = rb.make();
    const Polyhedron sum = valid(minkowski_sum(a, b), "sum");
    RC_ASSERT(nef::equal(sum, minkowski_sum(b, a)));
    RC_ASSERT(sum.is_empty() == (a.is_empty() || b.is_empty()));
    const Polyhedron turned = negate(b);
    for (const Rational3& x : hard_points(sum, 6)) {
      RC_ASSERT(nef::contains(sum, x) == !nef::intersect(a, moved(turned, x)).is_empty());
    }
  });
}

TEST_CASE("random: both strategies, any number of threads and any order of unions give the same set", "[threads]") {
  check("strategies", 150, [] {
    const Polyhedron a = (*recipes(true, 4)).make();
    const Polyhedron b = (*recipes(true, 3, 2)).make();
    const Polyhedron first = minkowski_sum(a, b);
    MinkowskiOptions options;
    options.monitor = nef::Monitor().on_threads(3);
    RC_ASSERT(nef::equal(first, minkowski_sum(a, b, options)));
    for (const UnionStrategy strategy : {UnionStrategy::kQueue, UnionStrategy::kConvolution}) {
      options.strategy = strategy;
      RC_ASSERT(nef::equal(first, minkowski_sum(a, b, options)));
    }
    const std::vector<Polyhedron> sums = nef::test::sums_of_cells(a, b);
    for (const auto& [name, order] : nef::test::kUnionOrders) RC_ASSERT(nef::equal(first, united(sums, order)));
  });
}

TEST_CASE("random: sums distribute over unions, move with their operands, are open beside an open set") {
  check("algebra", 100, [] {
    const Polyhedron a = (*recipes(true, 3)).make();
    const Polyhedron b = (*recipes(true, 2, 2)).make();
    const Polyhedron c = (*recipes(true, 2, 2)).make();
    const Polyhedron sum = minkowski_sum(a, b);
    RC_ASSERT(nef::equal(minkowski_sum(a, nef::unite(b, c)), nef::unite(sum, minkowski_sum(a, c))));
    const Rational3 by = {Rational(-5), Rational(1, 3), Rational(7)};
    RC_ASSERT(nef::equal(minkowski_sum(moved(a, by), b), moved(sum, by)));
    RC_ASSERT(nef::equal(minkowski_sum(a, nef::make_point(by)), moved(a, by)));
    RC_ASSERT(minkowski_sum(a, nef::interior(b)).is_open());
    RC_ASSERT(minkowski_sum(nef::closure(a), nef::closure(b)).is_closed());
  });
}

TEST_CASE("random: cells are convex, disjoint inside, and reassemble to the set") {
  check("decomposition", 400, [] {
    const Recipe recipe = *recipes(true, 5);
    const Polyhedron a = recipe.make();
    Rational content;
    std::vector<Polyhedron> sets;
    for (const ConvexCell& cell : decompose(a)) {
      const nef::Hull hull = nef::hull_of(cell.mesh.vertices);
      RC_ASSERT(hull.dimension == cell.dimension);
      RC_ASSERT(hull.mesh.vertices.size() == cell.mesh.vertices.size());
      RC_ASSERT(hull.mesh.face_count() == cell.mesh.face_count());
      sets.push_back(valid(to_polyhedron(cell), "cell"));
      if (cell.dimension == 3) content += *nef::volume(sets.back());
    }
    RC_ASSERT(content == *nef::volume(a));
    RC_ASSERT(nef::equal(nef::unite_all(sets), a));
  });
}

// A box or a tetrahedron on a small grid, closed, open, or with half of its faces.
rc::Gen<ConvexCell> solids() {
  const auto raw = rc::gen::container<std::array<int, 14>>(rc::gen::inRange(0, 4));
  return rc::gen::map(raw, [](const std::array<int, 14>& n) {
    std::vector<Rational3> points;
    for (std::size_t i = 0; i < 4; ++i)
      points.push_back({Rational(n[3 * i]), Rational(n[3 * i + 1]), Rational(n[3 * i + 2])});
    if (n[12] < 2 || nef::hull_of(points).dimension < 3) {
      points.clear();
      for (unsigned k = 0; k < 8; ++k) {
        Rational3 p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = n[i] + ((k >> i & 1U) != 0 ? 1 + n[3 + i] % 3 : 0);
        points.push_back(p);
      }
    }
    ConvexCell cell = nef::minkowski::hull_cell(points);
    if (n[13] == 1) return nef::minkowski::opened(std::move(cell));
    if (n[13] == 2) {
      cell.boundary = ConvexCell::Boundary::kMixed;
      for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) cell.facet_marks.push_back(f % 2 == 0 ? 1 : 0);
      cell.edge_marks.assign(cell.mesh.corners.size(), 0);
      cell.vertex_marks.assign(cell.mesh.vertices.size(), 0);
    }
    return cell;
  });
}

// The same cell turned, so that no plane is parallel to an axis, and moved by next to nothing, so that filters fail.
ConvexCell disturbed(ConvexCell cell, int step) {
  const Rational tiny = Rational(step, 3) / Rational(nef::Integer(1) << 60);
  for (Rational3& p : cell.mesh.vertices) {
    p = {Rational((p[0] + 2 * p[1] + 2 * p[2]) / 3 + tiny), Rational((2 * p[0] + p[1] - 2 * p[2]) / 3),
         Rational((2 * p[0] - 2 * p[1] + p[2]) / 3 - tiny)};
  }
  // That was a reflection: the faces run the other way now.
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    const auto first = static_cast<std::ptrdiff_t>(cell.mesh.face_begin[f]);
    const auto last = static_cast<std::ptrdiff_t>(cell.mesh.face_begin[f + 1]);
    std::reverse(cell.mesh.corners.begin() + first, cell.mesh.corners.begin() + last);
  }
  return cell;
}

TEST_CASE("random: the union of solids that all but coincide") {
  check("disturbed solid union", 200, [] {
    const auto count = *rc::gen::inRange<std::size_t>(2, 8);
    auto cells = *rc::gen::container<std::vector<ConvexCell>>(count, solids());
    Polyhedron expected;
    for (ConvexCell& cell : cells) {
      cell = disturbed(std::move(cell), *rc::gen::inRange(-1, 2));
      expected = nef::unite(expected, to_polyhedron(cell));
    }
    RC_ASSERT(nef::equal(valid(nef::minkowski::unite_solids(cells), "union"), expected));
  });
}

TEST_CASE("random: the union of solids at once is the union one by one") {
  check("solid union", 500, [] {
    const auto count = *rc::gen::inRange<std::size_t>(1, 9);
    const auto cells = *rc::gen::container<std::vector<ConvexCell>>(count, solids());
    Polyhedron expected;
    std::string text;
    for (const ConvexCell& cell : cells) {
      expected = nef::unite(expected, to_polyhedron(cell));
      text += "(" + std::to_string(static_cast<int>(cell.boundary));
      for (const Rational3& p : cell.mesh.vertices) {
        text += " " + nef::to_string(p[0]) + "," + nef::to_string(p[1]) + "," + nef::to_string(p[2]);
      }
      text += ") ";
    }
    RC_LOG() << text;
    RC_ASSERT(nef::equal(valid(nef::minkowski::unite_solids(cells), "union"), expected));
  });
}

}  // namespace
