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

namespace {

Rational power_of_ten(int exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  return exponent < 0 ? Rational(Integer(1), power) : Rational(power);
}

// Maps so close to the identity that only exact arithmetic sees them.
rc::Gen<AffineMap> tiny_maps() {
  return rc::gen::apply(
      [](int exponent, int row, int column, bool shear) {
        AffineMap map = AffineMap::identity();
        const Rational tiny = power_of_ten(-exponent);
        if (shear) {
          map.linear[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] += tiny;
        } else {
          map.translation[static_cast<std::size_t>(row)] = tiny;
        }
        return map;
      },
      rc::gen::inRange(10, 60), rc::gen::inRange(0, 3), rc::gen::inRange(0, 3), rc::gen::arbitrary<bool>());
}

}  // namespace

TEST_CASE("a set and a copy of it moved by less than doubles can tell") {
  CHECK(rc::check("nearly equal operands", [] {
    const Recipe recipe = *recipes(true, 3);
    const AffineMap map = *tiny_maps();
    const Polyhedron a = recipe.make();
    const Polyhedron b = transform(a, map);
    const Polyhedron common = intersect(a, b);
    const Polyhedron rest = subtract(a, b);
    same(unite(rest, common), a, "(A - B) + A * B = A");
    same(complement(unite(a, b)), intersect(complement(a), complement(b)), "!(A + B) = !A * !B");
    same(symmetric_difference(a, b), unite(rest, subtract(b, a)), "A ^ B = (A - B) + (B - A)");
    RC_ASSERT(*volume(a) + *volume(b) == *volume(common) + *volume(unite(a, b)));
    for (int i = 0; i < 10; ++i) {
      const Rational3 p = *adversarial_points();
      RC_ASSERT(contains(b, map(p)) == recipe.contains(p));
      RC_ASSERT(contains(common, map(p)) == (recipe.contains(p) && contains(a, map(p))));
    }
  }));
}

TEST_CASE("far from the origin") {
  CHECK(rc::check("translation by 10^k", [] {
    const bool bounded = *rc::gen::arbitrary<bool>();
    const Polyhedron a = (*recipes(bounded, 2).as("A")).make();
    const Polyhedron b = (*recipes(bounded, 2).as("B")).make();
    const int k = *rc::gen::inRange(10, 400);
    const AffineMap map = AffineMap::translate({power_of_ten(k), -power_of_ten(k / 2), Rational(1, 3)});
    same(transform(subtract(a, b), map), subtract(transform(a, map), transform(b, map)), "f(A - B) = f(A) - f(B)");
    same(transform(transform(unite(a, b), map),
                   AffineMap::translate({-power_of_ten(k), power_of_ten(k / 2), Rational(-1, 3)})),
         unite(a, b), "there and back");
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
