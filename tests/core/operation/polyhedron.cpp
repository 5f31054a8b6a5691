// SPDX-License-Identifier: Apache-2.0
//
// Sets are handles to complexes that they share.
#include "nef/polyhedron.h"

#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/query/measure.h"

namespace nef::test {
namespace {

TEST_CASE("A set gives its complex away, and those that share it keep theirs") {
  Polyhedron alone = make_box({0, 0, 0}, {1, 2, 3});
  const auto* const corners = alone.complex().corners.data();
  const Complex taken = std::move(alone).take_complex();
  CHECK(taken.corners.data() == corners);
  CHECK(alone.is_empty());  // NOLINT(bugprone-use-after-move): it is the empty set then

  Polyhedron shared = make_box({0, 0, 0}, {1, 2, 3});
  const Polyhedron other = shared;
  const Complex copy = std::move(shared).take_complex();
  CHECK(volume(copy) == Rational(6));
  CHECK(volume(other).value() == 6);
  CHECK(equal(other, Polyhedron(Complex(copy))));
  CHECK(shared.is_empty());  // NOLINT(bugprone-use-after-move)

  CHECK(Polyhedron().take_complex().vertex_count() == 0);
}

}  // namespace
}  // namespace nef::test
