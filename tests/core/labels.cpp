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

TEST_CASE("labels that merge simplify the complex") {
  const LabeledPolyhedron<int> a(make_box({0, 0, 0}, {1, 1, 1}), 0, 7);
  const LabeledPolyhedron<int> b(make_box({1, 0, 0}, {2, 1, 1}), 0, 7);
  const LabeledPolyhedron<int> both = overlay(a, b, [](int x, int y) { return std::max(x, y); });
  CHECK(both.polyhedron().complex().vertex_count() == 8);
}
