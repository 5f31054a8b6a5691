// SPDX-License-Identifier: Apache-2.0
//
// Where segments cross facets, as far as doubles tell: the bound of the crossing point against rationals where it is
// worst, and points on the border of a facet or a hair beside it.
#include "apps/planner/intersection/facet_meeting.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "apps/planner/intersection/item_tree.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/numbers/next_to_zero.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::planner::test {
namespace {

using nef::test::Genes;
using nef::test::NextToZero;

Approximation3 rough(const Rational3& p) {
  Approximation3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = nearest_double(p[i]);
    result[i] = {x, std::abs(x) * kRoundingUnit};
  }
  return result;
}

}  // namespace

TEST_CASE("the point where a form vanishes: the bound holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const double found = nef::test::worst(bits, 8, bits, [](const Genes& g) {
      const Rational3 a = nef::test::point_of_genes(g, 0, 7);
      const Rational3 b = nef::test::point_of_genes(g, 3, 7);
      const Rational at_a = abs(Rational(g[6]));
      const Rational at_b = -abs(Rational(g[7]));
      const auto form = [](const Rational& value) {
        const double x = nearest_double(value);
        return Approximation{x, std::abs(x) * kRoundingUnit};
      };
      const Approximation3 point = crossing_point(to_vector(a), to_vector(b), form(at_a), form(at_b));
      double part = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational truth = a[i] + at_a / (at_a - at_b) * (b[i] - a[i]);
        part = std::max(part, nef::test::part_of(exact_rational(point[i].value) - truth, point[i].error));
      }
      return part;
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 32);
  }
}

TEST_CASE("points on the border of a facet are not said to be in it or beside it", "[bounds]") {
  NextToZero random(1);
  for (int i = 0; i < 400; ++i) {
    const auto corners = vertex_on_facet(random).first;
    const Polyhedron solid = convex_hull(corners);
    const Complex& complex = solid.complex();
    // In the plane of the first three, from the border between the first two toward the third, or away from it.
    const Rational tiny = random.tiny();
    const Rational3 border = nef::test::along(corners[0], nef::test::from_to(corners[0], corners[1]), random.share());
    const Rational3 point = nef::test::along(border, nef::test::from_to(border, corners[2]), tiny);
    for (const FacetId f : complex.facets.ids()) {
      const auto vertices = complex.corners_of(f);
      const bool opposite = std::none_of(vertices.begin(), vertices.end(), [&](SHalfedgeId corner) {
        return complex.points.rational(point_of(complex.shalfedge_vertex(corner))) == corners[3];
      });
      if (!opposite) continue;
      const InFacet place = in_facet(complex, complex.facets[f], rough(point));
      CAPTURE(i, tiny);
      REQUIRE((place != InFacet::kInside || tiny > 0));
      REQUIRE((place != InFacet::kOutside || tiny < 0));
    }
  }
}

TEST_CASE("a segment through a vertex asks for all facets around it", "[bounds]") {
  NextToZero random(2);
  for (int i = 0; i < 400; ++i) {
    const auto two = vertex_on_facet(random);
    const Polyhedron solid = convex_hull(two.first);
    const Complex& complex = solid.complex();
    const ItemTree tree(complex);
    const Rational3 from = two.second[1 + random.below(3)];
    const Rational3 to = nef::test::along(from, nef::test::from_to(from, two.first[0]), 1 + random.share());
    std::set<std::uint32_t> found;
    tree.for_each_along(to_vector(from), to_vector(to), [&](const nef::ItemRef& item) {
      if (item.kind == nef::ItemRef::Kind::kFacet) found.insert(item.index);
      return true;
    });
    CAPTURE(i);
    for (const FacetId f : complex.facets.ids()) {
      const auto vertices = complex.corners_of(f);
      const bool around = std::any_of(vertices.begin(), vertices.end(), [&](SHalfedgeId corner) {
        return complex.points.rational(point_of(complex.shalfedge_vertex(corner))) == two.first[0];
      });
      REQUIRE((!around || found.count(static_cast<std::uint32_t>(f.index())) == 1));
    }
  }
}

}  // namespace nef::planner::test
