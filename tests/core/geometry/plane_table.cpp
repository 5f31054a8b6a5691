// SPDX-License-Identifier: Apache-2.0
//
// Planes that are merged at the end get the rows that they get one by one.
#include "nef/geometry/plane_table.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace nef {
namespace {

struct Coefficients {
  Integer a, b, c, d;
};

// Few different ones of the smaller kind; the others are long now and then, or differ from each other in signs only.
Coefficients random_plane(std::mt19937& random, bool few) {
  const auto number = [&]() -> Integer {
    if (few) return static_cast<int>(random() % 3) - 1;
    const Integer size = Integer(random()) * (random() % 8 == 0 ? Integer(1) << 90 : Integer(1));
    return random() % 2 == 0 ? size : Integer(-size);
  };
  Coefficients plane{number(), number(), number(), number()};
  if (plane.a == 0 && plane.b == 0 && plane.c == 0) plane.c = 1;
  return plane;
}

}  // namespace

TEST_CASE("planes merged at the end are those looked for one by one") {
  std::mt19937 random(5);
  for (const int count : {0, 1, 2, 50, 3000}) {
    for (const unsigned few_of_8 : {0U, 1U, 8U}) {
      CAPTURE(count, few_of_8);
      PlaneTable at_once;
      PlaneTable later;
      std::vector<PlaneId> expected;
      std::vector<PlaneId> found;
      later.merge_later();
      std::vector<Coefficients> planes;
      for (int i = 0; i < count; ++i) {
        Coefficients plane = random_plane(random, random() % 8 < few_of_8);
        if (!planes.empty() && random() % 16 == 0) plane.a = -planes.back().a;
        if (plane.a == 0 && plane.b == 0 && plane.c == 0) plane.c = 1;
        planes.push_back(plane);
        expected.push_back(at_once.intern(plane.a, plane.b, plane.c, plane.d));
        found.push_back(later.intern(plane.a, plane.b, plane.c, plane.d));
      }
      const std::vector<std::uint32_t> rows = later.merge_equal();
      if (!rows.empty()) {
        for (PlaneId& plane : found) plane = plane.in_row(rows[plane.row()]);
      }
      CHECK(found == expected);
      REQUIRE(later.size() == at_once.size());
      for (std::uint32_t row = 0; row < later.size(); ++row) {
        const PlaneId plane = PlaneId::of_row(row);
        CHECK(later.approximate(plane) == at_once.approximate(plane));
        for (std::size_t i = 0; i < 5; ++i) {
          CHECK(mpz_cmp(later.coefficient(plane, i), at_once.coefficient(plane, i)) == 0);
        }
      }
      // What comes then is looked for again.
      for (const Coefficients& plane : planes) {
        CHECK(later.intern(plane.a, plane.b, plane.c, plane.d) == at_once.intern(plane.a, plane.b, plane.c, plane.d));
      }
      CHECK(later.size() == at_once.size());
    }
  }
}

}  // namespace nef
