// SPDX-License-Identifier: Apache-2.0
//
// Volume is additive; rigid and affine maps commute with everything.
#include "tests/laws/laws.h"

namespace nef::test {

TEST_CASE("volume is additive") {
  CHECK(rc::check("vol A + vol B = vol(A + B) + vol(A * B)", [] {
    const Polyhedron a = (*recipes(true, 4).as("A")).make();
    const Polyhedron b = (*recipes(true, 4).as("B")).make();
    const auto measure = [](const Polyhedron& p) {
      const std::optional<Rational> v = volume(p);
      RC_ASSERT(v.has_value());
      RC_ASSERT(*v >= 0);
      return *v;
    };
    const Rational total = measure(a) + measure(b);
    RC_ASSERT(total == measure(unite(a, b)) + measure(intersect(a, b)));
    RC_ASSERT(measure(a) == measure(subtract(a, b)) + measure(intersect(a, b)));
    RC_ASSERT(measure(interior(a)) == measure(a));
    RC_ASSERT(measure(closure(a)) == measure(a));
    RC_ASSERT(measure(boundary(a)) == 0);
  }));
}

TEST_CASE("affine maps commute with Boolean operations") {
  for_all_pairs("maps", 2, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron b = second.make();
    const AffineMap map = *rc::gen::element(AffineMap::translate({Rational(1, 3), Rational(-2), Rational(5, 7)}),
                                            AffineMap::scale({Rational(2), Rational(-1, 3), Rational(1)}),
                                            AffineMap{{{{Rational(0), Rational(1), Rational(0)},
                                                        {Rational(1), Rational(0), Rational(0)},
                                                        {Rational(1), Rational(1), Rational(1)}}},
                                                      {Rational(0), Rational(1), Rational(0)}},
                                            AffineMap{{{{Rational(3, 5), Rational(-4, 5), Rational(0)},
                                                        {Rational(4, 5), Rational(3, 5), Rational(0)},
                                                        {Rational(0), Rational(0), Rational(1)}}},
                                                      {Rational(0), Rational(0), Rational(0)}});
    const Polyhedron fa = transform(a, map);
    const Polyhedron fb = transform(b, map);
    same(transform(unite(a, b), map), unite(fa, fb), "f(A + B) = f(A) + f(B)");
    same(transform(intersect(a, b), map), intersect(fa, fb), "f(A * B) = f(A) * f(B)");
    same(transform(complement(a), map), complement(fa), "f(!A) = !f(A)");
    same(transform(interior(a), map), interior(fa), "f(int A) = int f(A)");
    for (int i = 0; i < 10; ++i) {
      const Rational3 p = *adversarial_points();
      RC_ASSERT(contains(fa, map(p)) == first.contains(p));
    }
  });
}

}  // namespace nef::test
