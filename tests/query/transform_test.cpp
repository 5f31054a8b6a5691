// SPDX-License-Identifier: Apache-2.0
//
// Translations, which keep all links, against a stretch and a map that undoes it, which are linked anew.
#include <catch2/catch.hpp>
#include <random>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

Rational3 random_point(std::mt19937& random, int half, int denominator) {
  Rational3 point;
  for (Rational& x : point) {
    x = Rational(std::uniform_int_distribution<int>(-half * denominator, half * denominator)(random), denominator);
    x.canonicalize();
  }
  return point;
}

// Boxes, plates, segments and points, open and closed, with cavities.
Polyhedron random_set(unsigned seed) {
  std::mt19937 random(seed);
  Polyhedron set;
  for (int i = 0; i < 7; ++i) {
    const Rational3 low = random_point(random, 4, 1);
    Rational3 high = low;
    for (Rational& x : high) x += static_cast<int>(random() % 4);
    const Polyhedron box = make_box(low, high);
    const Polyhedron part = random() % 3 == 0 ? interior(box) : box;
    set = random() % 4 == 0 ? symmetric_difference(set, part) : unite(set, part);
  }
  set = unite(set, make_segment(random_point(random, 5, 3), random_point(random, 5, 2)));
  return seed % 5 == 4 ? complement(set) : set;
}

TEST_CASE("a translated set is what any other way to it gives, item for item") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Polyhedron set = random_set(seed);
    std::mt19937 random(seed + 7);
    const Rational3 by = random_point(random, 50, 1 + static_cast<int>(random() % 40));
    const Polyhedron moved = transform(set, AffineMap::translate(by));
    const Complex& c = moved.complex();
    REQUIRE(validate(c) == "");
    const AffineMap half = AffineMap::scale({Rational(1, 2), Rational(1, 2), Rational(1, 2)});
    const Polyhedron other =
        transform(transform(set, AffineMap::scale({2, 2, 2})), AffineMap::translate(by).after(half));
    CHECK(equal(moved, other));
    const Complex& d = other.complex();
    REQUIRE(c.vertex_count() == d.vertex_count());
    for (const VertexId v : c.vertex_ids()) {
      const Rational3 was = set.complex().points.rational(point_of(v));
      const Rational3 is = c.points.rational(point_of(v));
      CHECK(is == Rational3{was[0] + by[0], was[1] + by[1], was[2] + by[2]});
      CHECK(is == d.points.rational(point_of(v)));
    }
    CHECK(c.twin == d.twin);
    CHECK(c.corners == d.corners);
    CHECK(c.sface_shell == d.sface_shell);
  }
}

TEST_CASE("what is empty, everything or unbounded can be translated, too") {
  const AffineMap by = AffineMap::translate({Rational(1, 3), 2, -5});
  CHECK(transform(Polyhedron(), by).is_empty());
  CHECK(transform(Polyhedron::everything(), by).is_everything());
  const Polyhedron half_space = make_halfspace(1, 2, 3, 4, true);
  CHECK(equal(transform(transform(half_space, by), AffineMap::translate({-Rational(1, 3), -2, 5})), half_space));
}

}  // namespace
}  // namespace nef
