// SPDX-License-Identifier: Apache-2.0
//
// Places of points and lines of an arrangement, where they were looked at before; what they spare is tested with the
// sums that they are for (convolution_sum_test, morphology_test).
#include "apps/minkowski/convolution/known_places.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace {

using nef::Box;
using nef::minkowski::KnownLine;
using nef::minkowski::KnownLines;
using nef::minkowski::PlacesOfPoints;

TEST_CASE("points are found in boxes around their places, far from others") {
  PlacesOfPoints places(8);
  places.add({1.5, -2.25, 7.75}, 4);
  places.add({1.5, -2.25, 7.75}, 5);
  places.add({-1.5, 2.25, 0}, 6);
  Box box;
  box.add_rounded({1.5 + places.size() / 8, -2.25 + places.size() / 8, 7.75 + places.size() / 8});
  const auto near = places.near(box);
  CHECK(std::count(near.begin(), near.end(), 4U) == 1);
  CHECK(std::count(near.begin(), near.end(), 5U) == 1);
  CHECK(std::count(near.begin(), near.end(), 6U) == 0);
  box.add_rounded({1.5 + 2 * places.size(), -2.25, 7.75});
  CHECK(places.near(box).empty());
}

TEST_CASE("a known line answers for facets along it and its part") {
  KnownLines lines;
  Box part;
  part.add_rounded({0, 0, 0});
  part.add_rounded({4, 0, 0});
  lines.add(KnownLine{{1, 2, 3, 5, 8}, {2, 3, 8}, {10, 11}, part});
  Box inside;
  inside.low = {0.5, 0, 0};
  inside.high = {2, 0, 0};
  REQUIRE(lines.find(2, 3, inside) != nullptr);
  CHECK(lines.find(8, 2, inside)->points == std::vector<std::uint32_t>{10, 11});
  CHECK(lines.find(2, 5, inside) == nullptr);  // 5 may meet the part, but is not along the line
  lines.add_along(*lines.find(2, 3, inside), 5);
  CHECK(lines.find(2, 5, inside) != nullptr);
  CHECK(lines.find(5, 8, inside) != nullptr);
  inside.high[0] = 5;
  CHECK(lines.find(2, 3, inside) == nullptr);
}

}  // namespace
