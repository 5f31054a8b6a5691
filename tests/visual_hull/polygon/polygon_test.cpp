// SPDX-License-Identifier: Apache-2.0
//
// Turns in an image that are next to nothing: the sign is known by construction.
#include "apps/visual_hull/polygon/polygon.h"

#include <catch2/catch.hpp>

#include "tests/support/numbers/next_to_zero.h"

namespace nef::visual_hull::test {

using nef::Rational;
using nef::test::NextToZero;

TEST_CASE("three points of an image on a line, or a hair beside it", "[bounds]") {
  NextToZero random(1);
  for (int i = 0; i < 20000; ++i) {
    const unsigned bits = 6 + static_cast<unsigned>(random.below(50));
    const Rational scale = random.magnitude();
    const Rational x = random.number(bits);
    const Rational y = random.number(bits);
    const Rational dx = random.number(bits);
    const Rational dy = random.number(bits);
    if (dx == 0 && dy == 0) continue;
    const Rational t = random.share() * 3 - 1;
    const Rational tiny = random.tiny();
    const Point2 a(x * scale, y * scale);
    const Point2 b((x + dx) * scale, (y + dy) * scale);
    // A quarter turn to the left of the line from a to b.
    const Point2 c((x + t * dx - tiny * dy) * scale, (y + t * dy + tiny * dx) * scale);
    CAPTURE(i, tiny, scale);
    REQUIRE(orientation(a, b, c) == sgn(tiny));
    REQUIRE(orientation(c, b, a) == -sgn(tiny));
    REQUIRE((tiny == 0 || ring_orientation({a, b, c}) == sgn(tiny)));
    REQUIRE(on_segment(a, b, c) == (tiny == 0 && t >= 0 && t <= 1));
  }
}

}  // namespace nef::visual_hull::test
