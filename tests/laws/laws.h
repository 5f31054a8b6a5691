// SPDX-License-Identifier: Apache-2.0
//
// Asserting equality of sets inside a property, with both sides validated and shown.
#pragma once

#include <catch2/catch.hpp>

#include "tests/support/shapes/random_polyhedra.h"

namespace nef::test {

/// Fails the property unless both are valid and the same set: there is no point where their marks differ, and `equal`
/// says so, too.
inline void same(const Polyhedron& a, const Polyhedron& b, const std::string& law) {
  const std::string broken_a = validate(a.complex());
  const std::string broken_b = validate(b.complex());
  if (!broken_a.empty()) RC_FAIL(law + ", left side: " + broken_a);
  if (!broken_b.empty()) RC_FAIL(law + ", right side: " + broken_b);
  const auto differ = [](LabelId x, LabelId y) { return static_cast<LabelId>(x != y); };
  if (!overlay(a, b, differ).is_empty()) RC_FAIL(law + ": " + count_text(a) + " is not " + count_text(b));
  if (!equal(a, b)) RC_FAIL(law + ": equal() tells sets apart that do not differ");
}

/// Runs a property over one recipe, first bounded ones, then unbounded ones.
template <typename Property>
void for_all(const std::string& name, std::size_t steps, Property property) {
  CHECK(rc::check(name + " (bounded)", [&] { property(*recipes(true, steps)); }));
  CHECK(rc::check(name + " (unbounded)", [&] { property(*recipes(false, steps)); }));
}

/// The same over two recipes.
template <typename Property>
void for_all_pairs(const std::string& name, std::size_t steps, Property property) {
  CHECK(rc::check(name + " (bounded)", [&] {
    const Recipe a = *recipes(true, steps).as("A");
    const Recipe b = *recipes(true, steps).as("B");
    property(a, b);
  }));
  CHECK(rc::check(name + " (unbounded)", [&] {
    const Recipe a = *recipes(false, steps).as("A");
    const Recipe b = *recipes(false, steps).as("B");
    property(a, b);
  }));
}

}  // namespace nef::test
