// SPDX-License-Identifier: Apache-2.0
//
// Coplanar facets nested in each other and side by side. RC_PARAMS="max_success=100000" runs the property for long.
#include <rapidcheck.h>
#include <catch2/catch.hpp>

#include "tests/laws/laws.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/nested_planes/recipe_maker.h"

namespace nef::test {
namespace {

// An isolated point of a facet inside a loop of slits, beside a neighbour across a slit.
constexpr const char* kLoopBesideSlit =
    "(polygon(0,0,0,9,0,0,9,9,0,0,9,0) - segment(3,0,0,3,9,0) - segment(5,3,0,7,3,0) - segment(7,3,0,7,5,0)"
    " - segment(7,5,0,5,5,0) - segment(5,5,0,5,3,0)"
    " - polygon(5.5,3.5,0,6.5,3.5,0,6.5,4.5,0,5.5,4.5,0))";

TEST_CASE("a hole in a loop of slits beside a dividing slit is no part of the set", "[nested]") {
  CHECK(set(std::string(kLoopBesideSlit) + " * point(6,4,0)").is_empty());
  CHECK(contains(set(kLoopBesideSlit), {Rational(21, 4), Rational(4), Rational(0)}));
}

TEST_CASE("a pit in a ring in a floor beside a higher floor", "[nested]") {
  // box(2,0,-9,9,9,0) - (ring with a pillar in it) + block beside.
  const std::string solid =
      "box(2,0,-9,9,9,0) - (box(4,2,-1,8,6,1) - box(5,3,-1,7,5,1))"
      " - box(11/2,7/2,-1/2,13/2,9/2,1) + box(0,0,0,2,9,9)";
  const Polyhedron made = set(solid);
  CHECK(intersect(made, set("segment(6,4,-1/4,6,4,1)")).is_empty());
  CHECK(volume(made) == Rational(9 * 7 * 9 - (16 - 4) - Rational(1, 2) + 2 * 9 * 9));
}

TEST_CASE("a hole through a floor beside a block, in either order", "[nested]") {
  const std::string cut = " - box(3/2,5/4,-1,2,7/4,2)) * box(25/16,21/16,-1,15/8,27/16,1)";
  const std::string floor = "polygon(0,0,0,4,0,0,4,3,0,0,3,0)";
  CHECK(set("(box(1,1,0,3,2,1) + box(-1,0,0,0,3,1) + " + floor + cut).is_empty());
  CHECK(set("(box(-1,0,0,0,3,1) + " + floor + " + box(1,1,0,3,2,1)" + cut).is_empty());
  CHECK(set("(" + floor + " + box(1,1,0,3,2,1) + box(-1,0,0,0,3,1)" + cut).is_empty());
}

TEST_CASE("nested coplanar facets are what a grid says", "[nested]") {
  CHECK(rc::check("nested planes", [] {
    const auto seed = *rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>());
    const nested::Recipe recipe = nested::Maker(seed).make();
    const std::string wrong = nested::fault(recipe, seed, 60);
    if (wrong.empty()) return;
    const nested::Recipe small =
        nested::smallest(recipe, [&](const nested::Recipe& less) { return !nested::fault(less, seed, 2000).empty(); });
    RC_FAIL(wrong + "; at its smallest: " + small.text() + ": " + nested::fault(small, seed, 2000));
  }));
}

}  // namespace
}  // namespace nef::test
