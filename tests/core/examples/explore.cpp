// SPDX-License-Identifier: Apache-2.0
//
// Operators, ranges of items and visitors: what ports from CGAL line by line (docs/coming_from_cgal.md).
#include "nef/query/explore.h"

#include <catch2/catch.hpp>
#include <set>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/operators.h"

namespace nef {

TEST_CASE("operators are the operations") {
  const Polyhedron a = make_box({0, 0, 0}, {2, 2, 2});
  const Polyhedron b = make_box({1, 1, 1}, {3, 3, 3});
  CHECK(volume(a + b) == Rational(15));
  CHECK(volume(a * b) == Rational(1));
  CHECK(volume(a - b) == Rational(7));
  CHECK(volume(a ^ b) == Rational(14));
  CHECK(equal(!a * b, b - a));
  Polyhedron c = a;
  c += b;
  c -= b;
  CHECK(equal(c, a - b));
  c ^= a;
  CHECK(equal(c, a * b));
  c *= make_point({1, 1, 1});
  CHECK(equal(c, make_point({1, 1, 1})));
}

TEST_CASE("items are walked through, and shells visit each of theirs once") {
  // A plate with a window and a cavity in it.
  const Polyhedron plate = make_box({0, 0, 0}, {9, 9, 3});
  const Polyhedron set = plate - make_box({6, 6, 0}, {8, 8, 3}) - make_box({1, 1, 1}, {2, 2, 2});
  CHECK(vertices(set).size() == 24);
  CHECK(halfedges(set).size() == 72);
  CHECK(facets(set).size() == 16);
  REQUIRE(volumes(set).size() == 3);
  std::set<Rational3> points;
  for (const VertexId v : vertices(set)) points.insert(point(set, v));
  CHECK(points.size() == 24);
  CHECK(points.contains(Rational3{8, 6, 3}));

  // Two facets have a hole; all cycles have four corners, which differ.
  int cycles = 0;
  int holes = 0;
  for (const FacetId f : facets(set)) {
    int of_facet = 0;
    visit_cycles(set, f, [&](std::span<const VertexId> ring) {
      CHECK(std::set<VertexId>(ring.begin(), ring.end()).size() == 4);
      ++of_facet;
    });
    cycles += of_facet;
    holes += of_facet - 1;
  }
  CHECK(cycles == 18);
  CHECK(holes == 2);

  // The plate has two shells, one of them around the cavity; space and the cavity have one each.
  std::multiset<std::array<int, 3>> seen;
  std::multiset<int> shells_of;
  for (const VolumeId volume : volumes(set)) {
    int count = 0;
    for (const ShellId shell : shells(set, volume)) {
      std::array<int, 3> items{};
      visit_shell(
          set, shell, [&](VertexId) { ++items[0]; }, [&](HalfedgeId) { ++items[1]; }, [&](FacetId) { ++items[2]; });
      seen.insert(items);
      ++count;
    }
    shells_of.insert(count);
  }
  CHECK(shells_of == std::multiset<int>{1, 1, 2});
  CHECK(seen == std::multiset<std::array<int, 3>>{{8, 12, 6}, {8, 12, 6}, {16, 24, 10}, {16, 24, 10}});
}

TEST_CASE("vertices of an infimaximal box are no points") {
  const Polyhedron half = make_halfspace(0, 0, 1, 0);
  for (const VertexId v : vertices(half)) CHECK_THROWS_AS(point(half, v), InputError);
}

}  // namespace nef
