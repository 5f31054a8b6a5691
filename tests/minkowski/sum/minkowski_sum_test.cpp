// SPDX-License-Identifier: Apache-2.0
//
// Laws of Minkowski sums over a zoo of sets of all kinds: open, closed, neither, with missing points
// and slits, lower-dimensional, disconnected, hollow.
#include <atomic>
#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "tests/support/literals.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/union_orders.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::minkowski_sum;
using nef::test::hard_points;
using nef::test::moved;
using nef::test::set;
using nef::test::valid;

const std::vector<std::string>& zoo() {
  static const std::vector<std::string> kSets = {
      "box(0,0,0,2,2,2)",
      "interior(box(0,0,0,2,1,1))",
      "box(0,0,0,2,2,2) - point(1,1,1)",
      "box(0,0,0,2,2,2) - polygon(1/2,1/2,1, 3/2,1/2,1, 3/2,3/2,1)",
      "box(0,0,0,2,2,2) - segment(1,1,1/2, 1,1,3/2)",
      "box(0,0,0,2,2,1) - interior(box(0,0,0,1,2,3))*box(0,0,1,2,2,1) - point(2,2,1)",
      "box(0,0,0,2,2,1) - polygon(0,0,1, 1,0,1, 1,2,1, 0,2,1)",
      "box(0,0,0,1,1,1) + segment(1,1,1, 3,2,1)",
      "box(0,0,0,1,1,1) + polygon(1,0,1, 3,0,2, 1,1,1)",
      "box(0,0,0,3,1,1) + box(0,0,0,1,3,1)",
      "interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))",
      "box(0,0,0,3,3,3) - interior(box(1,1,1,2,2,2))",
      "box(0,0,0,3,3,1) - box(1,1,-1,2,2,2)",
      "hull(0,0,0, 2,0,0, 0,2,0, 0,0,2)",
      "polygon(0,0,0, 2,0,0, 2,2,0, 0,2,0) - polygon(1/2,1/2,0, 1,1/2,0, 1,1,0)",
      "polygon(0,0,0, 3,0,1, 1,1,1) - point(1,1,1)",
      "segment(0,0,0, 1,2,1)",
      "segment(0,0,0, 0,0,1) - point(0,0,1)",
      "point(1,2,3) + point(-1,0,0)",
      "box(0,0,0,1,1,1) + box(1,1,1,2,2,2)",
      "box(0,0,0,1,1,1) + box(5,0,0,6,1,1)",
  };
  return kSets;
}

// A few partners, so that the number of pairs stays small.
const std::vector<std::string>& partners() {
  static const std::vector<std::string> kSets = {
      "box(-1,-1,-1,1,1,1) - polygon(-1,-1,1, 0,-1,1, 0,1,1)",
      "interior(hull(0,0,0, 1,0,0, 0,1,0, 0,0,1))",
      "segment(0,0,0, 1,0,0) - point(1,0,0)",
      "polygon(1,1,1, 2,1,1, 1,2,1)",
      "box(4,0,0,5,1,1) - point(9/2,1/2,1/2)",
  };
  return kSets;
}

TEST_CASE("sums commute, and x is in A + B iff A meets x - B") {
  for (std::size_t i = 0; i < zoo().size(); ++i) {
    const std::string& text_b = partners()[i % partners().size()];
    CAPTURE(zoo()[i], text_b);
    const Polyhedron a = set(zoo()[i]);
    const Polyhedron b = set(text_b);
    const Polyhedron sum = valid(minkowski_sum(a, b), "sum");
    CHECK(nef::equal(sum, minkowski_sum(b, a)));
    const Polyhedron turned = nef::minkowski::negate(b);
    std::vector<Rational3> points = hard_points(sum, 12);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool meets = !nef::intersect(a, moved(turned, points[k])).is_empty();
      CAPTURE(nef::to_string(points[k][0]), nef::to_string(points[k][1]), nef::to_string(points[k][2]));
      CHECK(nef::contains(sum, points[k]) == meets);
    }
  }
}

TEST_CASE("a set plus a point is the set moved, one point or two, for every set") {
  const Rational3 by = {Rational(1, 3), Rational(-7), Rational(2)};
  for (const std::string& text : zoo()) {
    CAPTURE(text);
    const Polyhedron a = set(text);
    CHECK(nef::equal(minkowski_sum(a, nef::make_point(by)), moved(a, by)));
    // Two points do not take the short cut of one: cells and their union must give A back.
    const Rational3 far = {Rational(100), Rational(0), Rational(0)};
    const Polyhedron two = nef::unite(nef::make_point(by), nef::make_point(far));
    CHECK(nef::equal(minkowski_sum(a, two), nef::unite(moved(a, by), moved(a, far))));
  }
}

TEST_CASE("translating an operand translates the sum, wherever the origin is") {
  const Rational3 by = {Rational(5), Rational(0), Rational(-1, 3)};
  for (std::size_t i = 0; i < zoo().size(); ++i) {
    const std::string& text_b = partners()[(i + 1) % partners().size()];
    CAPTURE(zoo()[i], text_b);
    const Polyhedron a = set(zoo()[i]);
    const Polyhedron b = set(text_b);
    CHECK(nef::equal(minkowski_sum(a, moved(b, by)), moved(minkowski_sum(a, b), by)));
  }
  const Polyhedron sum = minkowski_sum(set("box(0,0,0,1,1,1)"), set("box(5,0,0,6,1,1)"));
  CHECK(nef::equal(sum, set("box(5,0,0,7,2,2)")));
}

TEST_CASE("sums distribute over unions, and the empty set gives the empty set") {
  for (std::size_t i = 0; i < zoo().size(); i += 2) {
    const Polyhedron a = set(zoo()[i]);
    const Polyhedron b = set(partners()[i % partners().size()]);
    const Polyhedron c = set(partners()[(i + 3) % partners().size()]);
    CAPTURE(zoo()[i], i);
    CHECK(nef::equal(minkowski_sum(a, nef::unite(b, c)), nef::unite(minkowski_sum(a, b), minkowski_sum(a, c))));
    CHECK(minkowski_sum(a, Polyhedron()).is_empty());
    CHECK(minkowski_sum(Polyhedron(), a).is_empty());
  }
}

TEST_CASE("an open operand makes the sum open") {
  const Polyhedron ball = set("interior(hull(0,0,0, 1,0,0, 0,1,0, 0,0,1))");
  for (const std::string& text : zoo()) {
    CAPTURE(text);
    CHECK(minkowski_sum(set(text), ball).is_open());
  }
}

TEST_CASE("two closed sets give a closed set") {
  for (const std::string& text : zoo()) {
    CAPTURE(text);
    CHECK(minkowski_sum(nef::closure(set(text)), set("polygon(1,1,1, 2,1,1, 1,2,1)")).is_closed());
  }
}

TEST_CASE("all strategies and orders of unions give the same set") {
  using nef::minkowski::UnionStrategy;
  for (std::size_t i = 0; i < zoo().size(); i += 3) {
    const Polyhedron a = set(zoo()[i]);
    const Polyhedron b = set(partners()[(i + 2) % partners().size()]);
    std::optional<Polyhedron> first;
    for (const UnionStrategy strategy : {UnionStrategy::kAuto, UnionStrategy::kConvolution, UnionStrategy::kQueue}) {
      CAPTURE(zoo()[i], static_cast<int>(strategy));
      nef::minkowski::MinkowskiOptions options;
      options.strategy = strategy;
      const Polyhedron sum = minkowski_sum(a, b, options);
      if (!first) first = sum;
      CHECK(nef::equal(*first, sum));
    }
    const std::vector<Polyhedron> sums = nef::test::sums_of_cells(a, b);
    for (const auto& [name, order] : nef::test::kUnionOrders) CHECK(nef::equal(*first, united(sums, order)));
  }
}

TEST_CASE("unbounded operands with known sums") {
  const Polyhedron half = set("halfspace(1,0,0,-1)");  // x <= 1
  CHECK(nef::equal(minkowski_sum(half, set("box(0,0,0,2,2,2)")), set("halfspace(1,0,0,-3)")));
  CHECK(nef::equal(minkowski_sum(set("interior(box(0,0,0,2,2,2))"), half), set("interior(halfspace(1,0,0,-3))")));
  CHECK(nef::equal(minkowski_sum(half, set("box(0,0,0,2,2,2) - box(2,0,0,2,2,1)")), set("halfspace(1,0,0,-3)")));
  CHECK(nef::equal(minkowski_sum(half, set("box(0,0,0,2,2,2) - polygon(2,0,0, 2,2,0, 2,2,2, 2,0,2)")),
                   set("interior(halfspace(1,0,0,-3))")));
  CHECK(nef::equal(minkowski_sum(nef::interior(half), set("segment(0,0,0,1,1,1)")),
                   set("interior(halfspace(1,0,0,-2))")));
  // Quadrants, a plane, lines, a beam.
  CHECK(nef::equal(minkowski_sum(set("halfspace(1,0,0,0) * halfspace(0,1,0,0)"), set("box(0,0,0,1,2,1)")),
                   set("halfspace(1,0,0,-1) * halfspace(0,1,0,-2)")));
  CHECK(nef::equal(minkowski_sum(half, set("halfspace(-1,0,0,0)")), Polyhedron::everything()));
  const Polyhedron plane = set("boundary(halfspace(0,0,1,0))");
  CHECK(nef::equal(minkowski_sum(plane, set("segment(0,0,0,0,0,1) - point(0,0,0)")),
                   set("halfspace(0,0,1,-1) - halfspace(0,0,1,0)")));
  const Polyhedron line_x = nef::intersect(plane, set("boundary(halfspace(0,1,0,0))"));
  const Polyhedron line_y = nef::intersect(plane, set("boundary(halfspace(1,0,0,0))"));
  CHECK(nef::equal(minkowski_sum(line_x, line_y), plane));
  CHECK(nef::equal(
      minkowski_sum(nef::intersect(line_x, set("halfspace(-1,0,0,0)")), set("segment(0,0,0,0,1,0)")),
      set("halfspace(-1,0,0,0) * boundary(halfspace(0,0,1,0)) * halfspace(0,-1,0,0) * halfspace(0,1,0,-1)")));
  // Not convex: the outside of a cube plus a smaller cube, and of the same cube: a point is left.
  const Polyhedron outside = set("!interior(box(0,0,0,2,2,2))");
  CHECK(nef::equal(minkowski_sum(outside, set("box(0,0,0,1,1,1)")), set("!interior(box(1,1,1,2,2,2))")));
  CHECK(nef::equal(minkowski_sum(set("!box(0,0,0,2,2,2)"), set("box(0,0,0,2,2,2)")), set("!point(2,2,2)")));
  CHECK_THROWS_AS(nef::minkowski::decompose(half), nef::UnsupportedError);
}

TEST_CASE("x is in A + B iff A meets x - B, for unbounded sets") {
  const std::vector<std::string> sets = {
      "halfspace(1,1,0,-2) + box(0,0,0,3,1,1)", "halfspace(1,0,0,0) * interior(halfspace(0,1,1,-1)) - point(-1,0,0)",
      "!box(0,0,0,2,2,2) - segment(3,0,0,5,0,0)", "boundary(halfspace(1,1,1,-1)) - point(1,0,0)"};
  const std::vector<std::string> others = {"box(0,0,0,1,1,1) + segment(1,1,1,2,1,1)", "point(0,0,0) + point(1,1,2)",
                                           "interior(box(0,0,0,2,2,2))", "halfspace(0,1,0,0) * halfspace(1,0,0,0)"};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string& text_b = others[i];
    CAPTURE(sets[i], text_b);
    const Polyhedron a = set(sets[i]);
    const Polyhedron b = set(text_b);
    const Polyhedron sum = valid(minkowski_sum(a, b), "sum");
    const Polyhedron turned = nef::minkowski::negate(b);
    for (int k = 0; k < 27; ++k) {
      const Rational3 x = {Rational(k % 3 * 3 - 2, 2), Rational(k / 3 % 3 * 2 - 1), Rational(k / 9 * 3 - 1, 2)};
      CHECK(nef::contains(sum, x) == !nef::intersect(a, moved(turned, x)).is_empty());
    }
  }
}

// Sums are told to stop by who is told that so much is done.
void check_that_it_stops(const Polyhedron& a, nef::minkowski::UnionStrategy strategy, std::size_t at) {
  std::atomic<bool> stop = false;
  const nef::ProgressFunction told = [&](const char*, std::size_t done, std::size_t) { stop = stop || done >= at; };
  const nef::Monitor monitor = nef::Monitor().telling(told).stopped_by(&stop);
  CHECK_THROWS_AS(minkowski_sum(a, a, {strategy, monitor}), nef::Interrupted);
}

// The thousandths that a sum of a set and itself tells of.
std::vector<std::size_t> told_of(const Polyhedron& a, nef::minkowski::UnionStrategy strategy,
                                 nef::minkowski::MinkowskiReport& report) {
  std::vector<std::size_t> seen{0};
  const nef::ProgressFunction told = [&seen](const char* phase, std::size_t done, std::size_t all) {
    if (phase != nef::minkowski::kSumPhase) return;
    CHECK(seen.back() <= done);
    CHECK(done <= all);
    CHECK(all == 1000);
    seen.push_back(done);
  };
  minkowski_sum(a, a, {strategy, nef::Monitor().telling(told)}, &report);
  CHECK(seen.back() == 1000);
  return seen;
}

TEST_CASE("who watches a sum by cells is told thousandths of the work, and can stop it") {
  const Polyhedron a = set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1) + box(2,0,0,3,3,1) + box(0,0,0,1,1,3)");
  nef::minkowski::MinkowskiReport report;
  const std::vector<std::size_t> seen = told_of(a, nef::minkowski::UnionStrategy::kQueue, report);
  CHECK(seen.size() > report.pairs);
  // No step is longer than half of it all: it goes by what is united, not by what went into the union.
  for (std::size_t i = 2; i < seen.size(); ++i) CHECK(seen[i] - seen[i - 1] < 500);
  check_that_it_stops(a, nef::minkowski::UnionStrategy::kQueue, 500);  // in the union
  check_that_it_stops(a, nef::minkowski::UnionStrategy::kQueue, 0);
}

TEST_CASE("who watches a sum without cells is told thousandths, and can stop it") {
  const Polyhedron a = set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1)");
  nef::minkowski::MinkowskiReport report;
  CHECK(told_of(a, nef::minkowski::UnionStrategy::kConvolution, report).size() > 2);
  check_that_it_stops(a, nef::minkowski::UnionStrategy::kConvolution, 1000);
}

TEST_CASE("convexity with marks") {
  using nef::minkowski::is_convex;
  CHECK(is_convex(set("box(0,0,0,2,2,2)")));
  CHECK(is_convex(set("interior(box(0,0,0,2,2,2))")));
  CHECK(is_convex(set("box(0,0,0,2,2,2) - point(0,0,0)")));
  CHECK(is_convex(set("interior(box(0,0,0,2,2,2)) + segment(1/2,1/2,2, 1,1,2)")));
  CHECK_FALSE(is_convex(set("box(0,0,0,2,2,2) - point(1,0,0)")));
  CHECK_FALSE(is_convex(set("box(0,0,0,2,2,2) - point(1,1,0)")));
  CHECK_FALSE(is_convex(set("box(0,0,0,2,2,2) - point(1,1,1)")));
  CHECK_FALSE(is_convex(set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1)")));
  CHECK_FALSE(is_convex(set("point(0,0,0) + point(1,0,0)")));
  CHECK(is_convex(set("segment(0,0,0,1,1,1) - point(1,1,1)")));
  CHECK_FALSE(is_convex(set("segment(0,0,0,2,2,2) - point(1,1,1)")));
  CHECK(is_convex(set("polygon(0,0,0, 2,0,0, 0,2,0)")));
  CHECK_FALSE(is_convex(set("polygon(0,0,0, 2,0,0, 0,2,0) - segment(0,0,0, 2,0,0) + point(1,0,0) + point(0,0,0)")));
}

// Facet by facet it took seconds for a ball of a thousand vertices.
TEST_CASE("whether a closed or open set of many facets is convex takes little more than a look at each") {
  const auto predicates = [](int splits, bool open) {
    const Polyhedron ball = nef::from_mesh(nef::test::geodesic_sphere(splits, 1, 0));
    const Polyhedron asked = open ? interior(ball) : ball;
    nef::PredicateCounts counts;
    CHECK(nef::minkowski::is_convex(asked, nef::Monitor().counting(counts)));
    return static_cast<double>(counts.identity + counts.filter + counts.exact);
  };
  for (const bool open : {false, true}) CHECK(predicates(10, open) < 6 * predicates(5, open));  // 4 times as many
}

}  // namespace
