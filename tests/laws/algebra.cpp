// SPDX-License-Identifier: Apache-2.0
//
// Boolean algebra. Equality is structural, since the representation is unique: these laws catch a
// wrong mark and a redundant item alike.
#include "tests/laws/laws.h"

namespace nef::test {

TEST_CASE("operations of one set") {
  for_all("A op A", 4, [](const Recipe& recipe) {
    const Polyhedron a = recipe.make();
    const Polyhedron none;
    const Polyhedron all = Polyhedron::everything();
    same(complement(complement(a)), a, "!!A = A");
    same(unite(a, a), a, "A + A = A");
    same(intersect(a, a), a, "A * A = A");
    same(symmetric_difference(a, a), none, "A ^ A = nothing");
    same(subtract(a, a), none, "A - A = nothing");
    same(unite(a, complement(a)), all, "A + !A = everything");
    same(intersect(a, complement(a)), none, "A * !A = nothing");
    same(symmetric_difference(a, all), complement(a), "A ^ everything = !A");
    same(unite(a, none), a, "A + nothing = A");
    same(intersect(a, all), a, "A * everything = A");
    same(subtract(all, a), complement(a), "everything - A = !A");
  });
}

TEST_CASE("operations of two sets") {
  for_all_pairs("A op B", 3, [](const Recipe& first, const Recipe& second) {
    const Polyhedron a = first.make();
    const Polyhedron b = second.make();
    const Polyhedron both = intersect(a, b);
    const Polyhedron either = unite(a, b);
    const Polyhedron only_a = subtract(a, b);
    same(either, unite(b, a), "A + B = B + A");
    same(both, intersect(b, a), "A * B = B * A");
    same(symmetric_difference(a, b), symmetric_difference(b, a), "A ^ B = B ^ A");
    same(complement(either), intersect(complement(a), complement(b)), "!(A + B) = !A * !B");
    same(complement(both), unite(complement(a), complement(b)), "!(A * B) = !A + !B");
    same(unite(a, both), a, "A + A * B = A");
    same(intersect(a, either), a, "A * (A + B) = A");
    same(unite(only_a, both), a, "(A - B) + A * B = A");
    same(intersect(only_a, both), Polyhedron(), "(A - B) * (A * B) = nothing");
    same(only_a, intersect(a, complement(b)), "A - B = A * !B");
    same(symmetric_difference(a, b), unite(only_a, subtract(b, a)), "A ^ B = (A - B) + (B - A)");
    same(symmetric_difference(either, both), symmetric_difference(a, b), "(A + B) ^ (A * B) = A ^ B");
  });
}

TEST_CASE("operations of three sets") {
  CHECK(rc::check("A op B op C", [] {
    const bool bounded = *rc::gen::arbitrary<bool>();
    const Polyhedron a = (*recipes(bounded, 2).as("A")).make();
    const Polyhedron b = (*recipes(bounded, 2).as("B")).make();
    const Polyhedron c = (*recipes(bounded, 2).as("C")).make();
    same(unite(unite(a, b), c), unite(a, unite(b, c)), "(A + B) + C = A + (B + C)");
    same(intersect(intersect(a, b), c), intersect(a, intersect(b, c)), "(A * B) * C = A * (B * C)");
    same(intersect(a, unite(b, c)), unite(intersect(a, b), intersect(a, c)), "A * (B + C) = A * B + A * C");
    same(unite(a, intersect(b, c)), intersect(unite(a, b), unite(a, c)), "A + B * C = (A + B) * (A + C)");
    same(symmetric_difference(symmetric_difference(a, b), c), symmetric_difference(a, symmetric_difference(b, c)),
         "(A ^ B) ^ C = A ^ (B ^ C)");
    const std::vector<Polyhedron> sets{a, b, c};
    same(unite_all(sets), unite(unite(a, b), c), "n-ary union");
    same(intersect_all(sets), intersect(intersect(a, b), c), "n-ary intersection");
  }));
}

TEST_CASE("n-ary operations of none and one") {
  const Polyhedron a = set("box(0,0,0,1,1,1)");
  CHECK(equal(unite_all({}), Polyhedron()));
  CHECK(equal(intersect_all({}), Polyhedron::everything()));
  CHECK(equal(unite_all({&a, 1}), a));
  CHECK(equal(intersect_all({&a, 1}), a));
}

TEST_CASE("n-ary union of many overlapping boxes is the folded union") {
  CHECK(rc::check("unite_all", [] {
    const auto boxes = *rc::gen::container<std::vector<Primitive>>(8, primitives(true, 4));
    std::vector<Polyhedron> sets;
    Polyhedron folded;
    Polyhedron common = Polyhedron::everything();
    for (const Primitive& primitive : boxes) {
      sets.push_back(set(primitive.text()));
      folded = unite(folded, sets.back());
      common = intersect(common, sets.back());
    }
    same(unite_all(sets), folded, "n-ary union");
    same(intersect_all(sets), common, "n-ary intersection");
  }));
}

}  // namespace nef::test
