// SPDX-License-Identifier: Apache-2.0
//
// Simplified offsets keep their bounds.
#include <catch2/catch.hpp>

#include "apps/minkowski/simplified/simplified_offset.h"
#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "tests/support/literals.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::offset;
using nef::minkowski::Side;
using nef::minkowski::simplified_offset;
using nef::minkowski::SimplifiedOffset;
using nef::test::set;
using nef::test::valid;

const char* const kBracket = "(box(0,0,0,8,8,2) - interior(box(3,-1,1,4,9,3))) + box(8,2,0,12,5/2,2)";

TEST_CASE("a simplified offset lies between two offsets, and is simple") {
  const Polyhedron a = set(kBracket);
  for (const Rational& radius : {Rational(1, 2), Rational(-1, 8)}) {
    for (const Side side : {Side::kInner, Side::kOuter}) {
      const Polyhedron exact = offset(a, radius, 3, side);
      const std::size_t triangles = to_mesh(exact).mesh.face_count();
      const SimplifiedOffset found = simplified_offset(a, radius, 3, side, {.triangles = triangles / 2, .digits = 2});
      valid(found.set, "simplified offset");
      const nef::Mesh mesh = to_mesh(found.set).mesh;
      CHECK(mesh.face_count() <= triangles / 2);
      for (const Rational3& vertex : mesh.vertices) {
        for (const Rational& x : vertex) CHECK(Rational(x * 100).get_den() == 1);
      }
      const bool outer = side == Side::kOuter;
      const Polyhedron far = offset(a, radius + (outer ? found.error : Rational(-found.error)), 3, side);
      CHECK(subtract(outer ? exact : found.set, outer ? found.set : exact).is_empty());
      CHECK(subtract(outer ? found.set : far, outer ? far : found.set).is_empty());
      CHECK(sgn(found.error) > 0);
    }
  }
}

TEST_CASE("simplified offsets: digits alone, nothing to do, and what is refused") {
  const Polyhedron a = set("box(0,0,0,1,1,1)");
  const SimplifiedOffset rounded = simplified_offset(a, Rational(1, 3), 2, Side::kOuter, {.digits = 4});
  CHECK(rounded.error < Rational(1, 10));
  CHECK(subtract(offset(a, Rational(1, 3), 2, Side::kOuter), rounded.set).is_empty());
  const SimplifiedOffset same = simplified_offset(a, 1, 1, Side::kInner, {.triangles = 100000});
  CHECK(equal(same.set, offset(a, 1, 1, Side::kInner)));
  CHECK(same.error == nef::minkowski::ball_approximation(1, 1, Side::kInner).error);
  CHECK_THROWS_AS(simplified_offset(a, 1, 1, Side::kOuter, {}), nef::InputError);
  CHECK_THROWS_AS(simplified_offset(a, 1, 1, Side::kOuter, {.digits = -1}), nef::InputError);
  CHECK_THROWS_AS(simplified_offset(a, -2, 1, Side::kOuter, {.digits = 1}), nef::InputError);
}

}  // namespace
