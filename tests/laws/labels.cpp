// SPDX-License-Identifier: Apache-2.0
//
// What is asked of a set with labels is asked of the points whose label is not 0.
#include <array>

#include "nef/construct/construct.h"
#include "tests/laws/laws.h"
#include "tests/support/shapes/labeled.h"

namespace nef::test {

TEST_CASE("unary operations on sets with labels") {
  for_all_pairs("labels", 2, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron with = labeled(a, second.make());
    same(without_labels(with), a, "the points");
    same(without_labels(a), a, "no labels");
    same(complement(with), complement(a), "!A");
    same(interior(with), interior(a), "int A");
    same(closure(with), closure(a), "cl A");
    same(boundary(with), boundary(a), "bd A");
    same(exterior(with), exterior(a), "ext A");
    same(regularize(with), regularize(a), "reg A");
    RC_ASSERT(with.is_empty() == a.is_empty());
    RC_ASSERT(with.is_everything() == a.is_everything());
    RC_ASSERT(with.is_bounded() == a.is_bounded());
    RC_ASSERT(with.is_open() == a.is_open());
    RC_ASSERT(with.is_closed() == a.is_closed());
    RC_ASSERT(with.is_regular() == a.is_regular());
    RC_ASSERT(volume(with) == volume(a));
  });
}

TEST_CASE("Booleans of sets with labels") {
  for_all_pairs("labels", 2, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron b = second.make();
    const Polyhedron with_a = labeled(a, b);
    const Polyhedron with_b = labeled(b, a);
    same(unite(with_a, with_b), unite(a, b), "A + B");
    same(intersect(with_a, with_b), intersect(a, b), "A * B");
    same(subtract(with_a, with_b), subtract(a, b), "A - B");
    same(symmetric_difference(with_a, with_b), symmetric_difference(a, b), "A ^ B");
    same(unite_all(std::array{with_a, b, with_b}), unite(a, b), "A + B + B");
    same(intersect_all(std::array{a, with_b, with_a}), intersect(a, b), "A * B * A");
    same(unite(with_a, Polyhedron()), a, "A + nothing");
    same(intersect(with_a, Polyhedron::everything()), a, "A * everything");
    same(subtract(with_a, Polyhedron()), a, "A - nothing");
    same(symmetric_difference(Polyhedron(), with_a), a, "nothing ^ A");
    same(subtract(with_a, make_point({Rational(100), 0, 0})), subtract(a, make_point({Rational(100), 0, 0})),
         "A - point");
    same(unite_all(std::array{with_a}), a, "A alone");
    same(intersect_all(std::array{with_a}), a, "A alone");
  });
}

}  // namespace nef::test
