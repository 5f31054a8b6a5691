// SPDX-License-Identifier: Apache-2.0
//
// Marks of other types than bool.
#include <catch2/catch.hpp>
#include <string>

#include "nef/construct/construct.h"
#include "nef/labeled_polyhedron.h"

namespace {

using nef::LabeledPolyhedron;
using nef::make_box;

std::string join(const std::string& a, const std::string& b) { return a == "air" ? b : (b == "air" ? a : a + "+" + b); }

}  // namespace

TEST_CASE("materials of two boxes") {
  const LabeledPolyhedron<std::string> steel(make_box({0, 0, 0}, {2, 2, 2}), "air", "steel");
  const LabeledPolyhedron<std::string> wood(make_box({1, 1, 1}, {3, 3, 3}), "air", "wood");
  const LabeledPolyhedron<std::string> both = overlay(steel, wood, join);
  CHECK(both.at({0, 0, 0}) == "steel");
  CHECK(both.at({1, 1, 1}) == "steel+wood");
  CHECK(both.at({2, 2, 2}) == "steel+wood");
  CHECK(both.at({3, 2, 2}) == "wood");
  CHECK(both.at({4, 0, 0}) == "air");
  // Air, steel alone, wood alone, and both.
  CHECK(both.polyhedron().complex().volume_count() == 4);
  CHECK(nef::validate(both.polyhedron().complex()).empty());
  CHECK(equal(both.where([](const std::string& s) { return s != "air"; }),
              unite(make_box({0, 0, 0}, {2, 2, 2}), make_box({1, 1, 1}, {3, 3, 3}))));
}

TEST_CASE("all of space is everything, whatever its labels") {
  const auto number = [](nef::LabelId x, nef::LabelId y) { return static_cast<nef::LabelId>(x + y); };
  const nef::Polyhedron all = overlay(nef::Polyhedron::everything(), make_box({0, 0, 0}, {1, 1, 1}), number);
  CHECK(all.complex().volume_count() == 2);
  CHECK(all.is_everything());
  CHECK(complement(all).is_empty());
  CHECK(intersect(all, make_box({0, 0, 0}, {2, 1, 1})).complex().label_count == 2);
}

TEST_CASE("how many boxes cover a point") {
  LabeledPolyhedron<int> depth(0);
  for (int i = 0; i < 5; ++i) {
    depth = overlay(depth, LabeledPolyhedron<int>(make_box({i, 0, 0}, {i + 3, 1, 1}), 0, 1), std::plus<>());
  }
  CHECK(depth.at({nef::Rational(5, 2), nef::Rational(1, 2), 0}) == 3);
  CHECK(depth.at({3, 0, 0}) == 4);  // closed boxes: one ends where another begins
  CHECK(depth.at({nef::Rational(1, 2), 0, 0}) == 1);
  CHECK(depth.at({8, 0, 0}) == 0);
  CHECK(nef::validate(depth.polyhedron().complex()).empty());
}

TEST_CASE("only labels that some point has are kept") {
  // Sums of powers of two: all subsets would be far too many.
  LabeledPolyhedron<long> sum(0);
  for (int i = 0; i < 40; ++i) {
    const LabeledPolyhedron<long> next(make_box({i, 0, 0}, {i + 1, 1, 1}), 0, 1L << i);
    sum = overlay(sum, next, std::plus<>());
  }
  CHECK(sum.labels().size() == 1 + 40 + 39);  // nothing, boxes, and walls between two of them
  CHECK(sum.at({nef::Rational(41, 2), 1, 1}) == 1L << 20);
  CHECK(sum.at({20, 1, 1}) == (1L << 20) + (1L << 19));
  CHECK(sum.at({-1, 0, 0}) == 0);
  CHECK(nef::validate(sum.polyhedron().complex()).empty());
  CHECK(equal(sum.where([](long label) { return label >= 1L << 38; }), make_box({38, 0, 0}, {40, 1, 1})));
}

TEST_CASE("labels of unbounded sets") {
  const LabeledPolyhedron<std::string> sea(nef::make_halfspace(0, 0, 1, 0), "air", "water");
  const LabeledPolyhedron<std::string> ice(make_box({0, 0, -2}, {2, 2, 1}), "air", "ice");
  const LabeledPolyhedron<std::string> both =
      overlay(sea, ice, [](const std::string& a, const std::string& b) { return b == "air" ? a : b; });
  CHECK(nef::validate(both.polyhedron().complex()).empty());
  CHECK(both.at({1, 1, 0}) == "ice");
  CHECK(both.at({0, 0, 1}) == "ice");
  CHECK(both.at({5, 5, 0}) == "water");
  CHECK(both.at({5, 5, 1}) == "air");
  CHECK(both.at({1000000, 1, -1000000}) == "water");
  CHECK(equal(both.where([](const std::string& s) { return s == "water"; }),
              subtract(nef::make_halfspace(0, 0, 1, 0), make_box({0, 0, -2}, {2, 2, 1}))));
}

TEST_CASE("labels that merge simplify the complex") {
  const LabeledPolyhedron<int> a(make_box({0, 0, 0}, {1, 1, 1}), 0, 7);
  const LabeledPolyhedron<int> b(make_box({1, 0, 0}, {2, 1, 1}), 0, 7);
  const LabeledPolyhedron<int> both = overlay(a, b, [](int x, int y) { return std::max(x, y); });
  CHECK(both.polyhedron().complex().vertex_count() == 8);
}

TEST_CASE("the function of an overlay is asked for the pairs of labels that occur") {
  // 40000 labels by 40000: a table of all pairs would take gigabytes.
  const nef::Polyhedron a = overlay(make_box({0, 0, 0}, {2, 2, 2}), nef::Polyhedron(),
                                    [](nef::LabelId x, nef::LabelId) { return static_cast<nef::LabelId>(40000 * x); });
  const nef::Polyhedron b = overlay(make_box({1, 1, 1}, {3, 3, 3}), nef::Polyhedron(),
                                    [](nef::LabelId x, nef::LabelId) { return static_cast<nef::LabelId>(40000 * x); });
  int asked = 0;
  const nef::Polyhedron both = overlay(a, b, [&asked](nef::LabelId x, nef::LabelId y) {
    ++asked;
    return static_cast<nef::LabelId>(x != 0 ? (y != 0 ? 3 : 40001) : (y != 0 ? 2 : 0));
  });
  CHECK(asked == 4);
  CHECK(nef::validate(both.complex()).empty());
  CHECK(both.complex().volume_count() == 4);
  CHECK(locate(both, {nef::Rational(1, 2), nef::Rational(1, 2), nef::Rational(1, 2)}).mark == 40001);
  CHECK(locate(both, {nef::Rational(3, 2), nef::Rational(3, 2), nef::Rational(3, 2)}).mark == 3);
  // Merging labels again simplifies untouched vertices, too.
  const nef::Polyhedron merged = overlay(both, make_box({8, 8, 8}, {9, 9, 9}), [](nef::LabelId x, nef::LabelId y) {
    return static_cast<nef::LabelId>(x != 0 || y != 0);
  });
  CHECK(nef::validate(merged.complex()).empty());
  CHECK(equal(merged, unite(unite(make_box({0, 0, 0}, {2, 2, 2}), make_box({1, 1, 1}, {3, 3, 3})),
                            make_box({8, 8, 8}, {9, 9, 9}))));
}

TEST_CASE("the reserved label is refused") {
  const nef::Polyhedron a = make_box({0, 0, 0}, {1, 1, 1});
  const auto reserved = [](nef::LabelId x, nef::LabelId y) {
    return x != 0 && y != 0 ? nef::kOutside : nef::LabelId{0};
  };
  CHECK_THROWS_AS(overlay(a, a, reserved), nef::InputError);
  CHECK_THROWS_WITH(overlay(a, a, reserved), Catch::Contains("65535"));
}

TEST_CASE("a set that was moved from is empty") {
  nef::Polyhedron a = make_box({0, 0, 0}, {1, 1, 1});
  const nef::Polyhedron b = std::move(a);
  // NOLINTBEGIN(bugprone-use-after-move)
  CHECK(a.is_empty());
  CHECK(equal(a, nef::Polyhedron()));
  CHECK(equal(unite(a, b), b));
  CHECK_FALSE(contains(a, {0, 0, 0}));
  CHECK(complement(a).is_everything());
  a = b;
  CHECK(equal(a, b));
  // NOLINTEND(bugprone-use-after-move)
}
