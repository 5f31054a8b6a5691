// SPDX-License-Identifier: Apache-2.0
//
// A sequence of steps gives the same set whether it works in tiles or not, and begins to where that pays.
#include "nef/tiles/step_sequence.h"

#include <catch2/catch.hpp>

#include "nef/construct/round_shapes.h"
#include "nef/io/native/native_binary.h"
#include "tests/tiles/cuts.h"

namespace nef::test {

TEST_CASE("many small steps are done in tiles, few are not") {
  const Polyhedron sphere = make_sphere(10, 60);
  const Tiling tiling{200};
  constexpr int kMany = 120;
  StepSequence few(sphere, 6, TileUse::kWherePays, tiling);
  StepSequence many(sphere, kMany, TileUse::kWherePays, tiling);
  StepSequence never(sphere, kMany, TileUse::kNever, tiling);
  StepSequence always(sphere, kMany, TileUse::kAlways, tiling);
  for (int i = 0; i < 6; ++i) few.apply(BooleanOperator::kDifference, notch(i));
  CHECK(few.tile_count() == 0);
  bool begun = false;
  for (int i = 0; i < kMany; ++i) {
    const auto op = i % 7 == 3 ? BooleanOperator::kSymmetricDifference : BooleanOperator::kDifference;
    for (StepSequence* sequence : {&many, &never, &always}) sequence->apply(op, notch(i));
    begun = begun || many.tile_count() > 1;
  }
  CHECK(begun);
  CHECK(never.tile_count() == 0);
  CHECK(always.tile_count() > 1);
  CHECK(native_binary(many.result()) == native_binary(never.result()));
  CHECK(native_binary(always.result()) == native_binary(never.result()));
}

TEST_CASE("a chain in tiles is the plain one at every hundredth of its way") {
  const Polyhedron sphere = make_sphere(10, 40);
  constexpr int kSteps = 100;
  for (const std::size_t limit : {40, 128}) {
    StepSequence plain(sphere, kSteps, TileUse::kNever);
    StepSequence tiled(sphere, kSteps, TileUse::kAlways, {limit});
    for (int i = 0; i < kSteps; ++i) {
      const auto op = i % 5 == 4 ? BooleanOperator::kSymmetricDifference : BooleanOperator::kDifference;
      plain.apply(op, notch(i));
      tiled.apply(op, notch(i));
      CAPTURE(limit, i);
      REQUIRE(equal(tiled.result(), plain.result()));
    }
    CHECK(native_binary(tiled.result()) == native_binary(plain.result()));
  }
}

TEST_CASE("large operands are met without tiles") {
  const Polyhedron sphere = make_sphere(10, 60);
  StepSequence sequence(sphere, 30, TileUse::kWherePays, Tiling{200});
  for (int i = 1; i <= 30; ++i) {
    sequence.apply(BooleanOperator::kIntersection, make_sphere(10 - Rational(i, 50), 60));
    CHECK(sequence.tile_count() == 0);
  }
}

}  // namespace nef::test
