// SPDX-License-Identifier: Apache-2.0
//
// What a milling tool leaves, against a search of positions on a grid. Parts and tools are unions of unit cubes. A
// position with whole coordinates is free if no cube of the tool is one of the part, and between two free neighbours
// the tool stays within its cubes at both; every free position lies in a cell of the grid all of whose corners are
// free. So the search finds what is connected, passages as wide as the tool included, and all that the tool covers.
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>
#include <vector>

#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/shapes/fixed_cases.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::Approach;
using nef::minkowski::Millable;
using nef::minkowski::millable;
using nef::test::set;

using Cell = std::array<int, 3>;
using Cells = std::set<Cell>;

Cell plus(const Cell& a, const Cell& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Polyhedron solid_of(const Cells& cells) {
  std::vector<Polyhedron> cubes;
  for (const Cell& c : cells) cubes.push_back(nef::make_box({c[0], c[1], c[2]}, {c[0] + 1, c[1] + 1, c[2] + 1}));
  return nef::unite_all(cubes);
}

constexpr int kFar = 8;  // beyond everything

bool is_free(const Cells& part, const Cells& tool, const Cell& at) {
  return std::none_of(tool.begin(), tool.end(), [&](const Cell& t) { return part.count(plus(at, t)) != 0; });
}

// The cells that the tool removes.
Cells removed(const Cells& part, const Cells& tool, Approach approach) {
  Cells positions;
  if (approach == Approach::kFromAbove) {
    for (int x = -kFar; x <= kFar; ++x) {
      for (int y = -kFar; y <= kFar; ++y) {
        for (int z = kFar; z >= -kFar && is_free(part, tool, {x, y, z}); --z) positions.insert({x, y, z});
      }
    }
  } else {
    std::vector<Cell> open{{-kFar, -kFar, -kFar}};
    positions.insert(open.back());
    while (!open.empty()) {
      const Cell at = open.back();
      open.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        for (const int step : {-1, 1}) {
          Cell next = at;
          next[i] += step;
          if (next[i] < -kFar || next[i] > kFar || !is_free(part, tool, next)) continue;
          if (positions.insert(next).second) open.push_back(next);
        }
      }
    }
  }
  Cells result;
  for (const Cell& at : positions) {
    for (const Cell& t : tool) result.insert(plus(at, t));
  }
  return result;
}

Cells random_cubes(const Cell& size, int share) {
  Cells cells;
  for (int x = 0; x < size[0]; ++x) {
    for (int y = 0; y < size[1]; ++y) {
      for (int z = 0; z < size[2]; ++z) {
        if (*rc::gen::inRange(0, 100) < share) cells.insert({x, y, z});
      }
    }
  }
  return cells;
}

// A cube, and some beside it.
Cells random_tool() {
  Cells tool{{0, 0, 0}};
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
    Cell next = *std::next(tool.begin(), *rc::gen::inRange<int>(0, static_cast<int>(tool.size())));
    next[static_cast<std::size_t>(*rc::gen::inRange(0, 3))] += *rc::gen::element(-1, 1);
    tool.insert(next);
  }
  return tool;
}

TEST_CASE("millable: the shape is what a search of positions on a grid leaves") {
  nef::test::check("millable", 60, [] {
    const Cell size{4, 4, 3};
    const Cells part = random_cubes(size, *rc::gen::element(30, 60, 85));
    const Cells tool = random_tool();
    RC_PRE(!part.empty());
    for (const Approach approach : {Approach::kAnywhere, Approach::kFromAbove}) {
      const Cells gone = removed(part, tool, approach);
      const Polyhedron body = solid_of(part);
      const Millable found = millable(body, solid_of(tool), approach);
      // Beyond the part's box nothing stays.
      std::size_t beyond = 0;
      Cell low = size;
      Cell high{0, 0, 0};
      for (const Cell& c : part) {
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], c[i]);
          high[i] = std::max(high[i], c[i] + 1);
        }
      }
      for (int x = low[0]; x < high[0]; ++x) {
        for (int y = low[1]; y < high[1]; ++y) {
          for (int z = low[2]; z < high[2]; ++z) {
            const Rational3 middle = {Rational(2 * x + 1, 2), Rational(2 * y + 1, 2), Rational(2 * z + 1, 2)};
            const bool left = gone.count({x, y, z}) == 0;
            RC_ASSERT(contains(found.shape, middle) == left);
            if (left && part.count({x, y, z}) == 0) ++beyond;
          }
        }
      }
      RC_ASSERT(subtract(body, found.shape).is_empty());
      Rational volume;
      for (const Polyhedron& region : found.unreached) volume += *nef::volume(region);
      RC_ASSERT(volume == Rational(static_cast<int>(beyond)));
      RC_ASSERT(*nef::volume(found.shape) == Rational(static_cast<int>(beyond + part.size())));
    }
  });
}

// A block with a slot as wide as the tool, one half as wide, an undercut beside a wide pocket, and a cavity.
TEST_CASE("millable: slots, undercuts and cavities") {
  const Polyhedron part =
      set("box(0,0,0, 20,3,4) - interior(box(1,-1,1, 2,9,9)) - interior(box(4,-1,1, 9/2,9,9)) - "
          "interior(box(7,-1,1, 10,9,9) + box(7,-1,1, 12,9,2)) - interior(box(15,1,1, 17,2,2))");
  const Polyhedron tool = set("box(-1/2,-1/2,0, 1/2,1/2,1)");
  const Polyhedron narrow = set("box(4,0,1, 9/2,3,4)");
  const Polyhedron undercut = set("box(10,0,1, 12,3,2)");
  const Polyhedron cavity = set("box(15,1,1, 17,2,2)");
  const Millable any = millable(part, tool);
  REQUIRE(any.unreached.size() == 2);
  CHECK(equal(any.unreached[0], narrow));
  CHECK(equal(any.unreached[1], cavity));
  CHECK(equal(any.shape, unite(part, unite(narrow, cavity))));
  const Millable above = millable(part, tool, Approach::kFromAbove);
  REQUIRE(above.unreached.size() == 3);
  CHECK(equal(above.unreached[0], undercut));
  CHECK(equal(above.shape, unite(any.shape, undercut)));
  // A fin stays, and what lies behind it from above does, too.
  const Polyhedron fin = set("box(0,0,0, 4,4,1) + polygon(0,0,3, 4,0,3, 4,4,3, 0,4,3)");
  CHECK(equal(millable(fin, tool, Approach::kFromAbove).shape, set("box(0,0,0, 4,4,3)")));
  CHECK(equal(millable(fin, tool).shape, fin));
  CHECK(millable(set("nothing"), tool).shape.is_empty());
  CHECK_THROWS_AS(millable(part, set("polygon(0,0,0, 1,0,0, 0,1,0)")), nef::InputError);
  CHECK_THROWS_AS(millable(set("halfspace(1,0,0,0)"), tool), nef::UnsupportedError);
}

}  // namespace
