// SPDX-License-Identifier: Apache-2.0
//
// Pieces chosen by volumes that are known, also ones that doubles cannot tell apart.
#include "nef/parts/by_volume.h"

#include <catch2/catch.hpp>

#include "nef/construct/construct.h"

namespace nef {

TEST_CASE("The largest piece is found where doubles decide and where they do not", "[parts]") {
  const Rational tiny = Rational(1) / (Rational(Integer(1) << 80U));
  const auto slab = [](const Rational& height) { return make_box({0, 0, 0}, {1, Rational(1, 3), height}); };
  const std::vector<Polyhedron> close{slab(Rational(1, 7)), slab(Rational(1, 7) + tiny), slab(Rational(1, 7) - tiny)};
  CHECK(largest_piece(close) == 1);
  CHECK(pieces_above(close, Rational(1, 21)).size() == 1);
  CHECK(pieces_above(close, Rational(1, 21) - tiny).size() == 3);
  CHECK(pieces_above(close, 1).empty());
  const std::vector<Polyhedron> several{slab(1), slab(3), make_halfspace(1, 0, 0, 0), slab(3)};
  CHECK(largest_piece(several) == 2);  // infinite
  CHECK(pieces_above(several, Rational(1, 2)).size() == 3);
  CHECK(largest_piece(std::vector<Polyhedron>{slab(3), slab(3), slab(1)}) == 0);
}

}  // namespace nef
