// SPDX-License-Identifier: Apache-2.0
//
// Borders against their definition: sides in pairs, and winding numbers of points beside each of them, in rationals.
#include "nef/mesh/polygon/plain_border.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>

namespace nef::test {
namespace {

using Point = std::array<Rational, 2>;

int turn(const Point& a, const Point& b, const Point& c) {
  return sgn(Rational((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
}

bool is_on(const Point& p, const Point& a, const Point& b) {
  return turn(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b);
}

// Of sides: true if each point that they have in common is an end of both, by its number.
bool meet_at_ends_only(const std::vector<Point>& at, const PlainBorder::Side& s, const PlainBorder::Side& t) {
  const Point& a = at[s[0]];
  const Point& b = at[s[1]];
  const Point& c = at[t[0]];
  const Point& d = at[t[1]];
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return false;
  const auto is_free = [&](std::uint32_t end, const PlainBorder::Side& other) {
    return other[0] == end || other[1] == end || !is_on(at[end], at[other[0]], at[other[1]]);
  };
  if (!is_free(s[0], t) || !is_free(s[1], t) || !is_free(t[0], s) || !is_free(t[1], s)) return false;
  return std::minmax(s[0], s[1]) != std::minmax(t[0], t[1]);
}

int winding_number(const std::vector<Point>& at, const std::vector<PlainBorder::Side>& sides, const Point& q) {
  int result = 0;
  for (const auto& [from, to] : sides) {
    const Point& a = at[from];
    const Point& b = at[to];
    if (a[1] <= q[1] && q[1] < b[1] && turn(a, b, q) > 0) ++result;
    if (b[1] <= q[1] && q[1] < a[1] && turn(a, b, q) < 0) --result;
  }
  return result;
}

// Points of a small grid of integers are so far from lines through others that a thousandth is close to a side.
bool is_surrounded_once(const std::vector<Point>& at, const std::vector<PlainBorder::Side>& sides, int around) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!meet_at_ends_only(at, sides[i], sides[j])) return false;
    }
  }
  for (const auto& [from, to] : sides) {
    const Point& a = at[from];
    const Point& b = at[to];
    for (const int side : {1, -1}) {
      const Point q{(a[0] + b[0]) / 2 + (b[1] - a[1]) * Rational(side, 1000),
                    (a[1] + b[1]) / 2 - (b[0] - a[0]) * Rational(side, 1000)};
      const int winding = winding_number(at, sides, q);
      if (winding != 0 && winding != around) return false;
    }
  }
  return true;
}

// The border of some of the triangles that the cells of a grid are cut into.
std::vector<PlainBorder::Side> border_of_cells(std::mt19937& random, std::uint32_t size) {
  std::map<PlainBorder::Side, int> balance;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (random() % 3 == 0) return;
    for (const auto& [from, to] : {PlainBorder::Side{a, b}, PlainBorder::Side{b, c}, PlainBorder::Side{c, a}}) {
      ++balance[{from, to}];
      --balance[{to, from}];
    }
  };
  for (std::uint32_t i = 0; i + 1 < size; ++i) {
    for (std::uint32_t j = 0; j + 1 < size; ++j) {
      const std::uint32_t low = i * size + j;
      add(low, low + size, low + size + 1);
      add(low, low + size + 1, low + 1);
    }
  }
  std::vector<PlainBorder::Side> sides;
  for (const auto& [side, count] : balance) {
    if (count > 0) sides.push_back(side);
  }
  return sides;
}

TEST_CASE("Borders that surround each point once at most") {
  std::mt19937 random(36);
  std::array<int, 2> count{};
  for (int round = 0; round < 4000; ++round) {
    constexpr std::uint32_t kSize = 6;
    std::vector<Point> at;
    for (std::uint32_t i = 0; i < kSize; ++i) {
      for (std::uint32_t j = 0; j < kSize; ++j) at.push_back({Rational(i), Rational(j)});
    }
    std::vector<PlainBorder::Side> sides;
    if (round % 2 == 0) {
      sides = border_of_cells(random, kSize);
      for (unsigned moved = random() % 3; moved > 0; --moved) {
        at[random() % at.size()] = {Rational(static_cast<int>(random() % kSize)),
                                    Rational(static_cast<int>(random() % kSize))};
      }
    } else {  // some cycles
      for (unsigned cycles = 1 + random() % 3; cycles > 0; --cycles) {
        std::vector<std::uint32_t> ring;
        for (unsigned corners = 3 + random() % 3; corners > 0; --corners) {
          ring.push_back(static_cast<std::uint32_t>(random() % at.size()));
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::uint32_t to = ring[(i + 1) % ring.size()];
          if (ring[i] != to) sides.push_back({ring[i], to});
        }
      }
    }
    const int around = random() % 2 == 0 ? 1 : -1;
    if (around < 0 && round % 2 == 0) {
      for (PlainBorder::Side& side : sides) std::swap(side[0], side[1]);
    }
    const bool ends_apart =
        std::none_of(sides.begin(), sides.end(), [&](const PlainBorder::Side& s) { return at[s[0]] == at[s[1]]; });
    const bool expected = ends_apart && is_surrounded_once(at, sides, around);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Rational3> places(at.size());
      for (std::size_t i = 0; i < at.size(); ++i) {
        places[i][axis] = static_cast<int>(random() % 9);
        places[i][(axis + 1) % 3] = at[i][0];
        places[i][(axis + 2) % 3] = at[i][1];
      }
      const MeshPoints points(places);
      PlainBorder border(points);
      CHECK(border.surrounds_once(sides, axis, around, {}) == expected);
      CHECK(border.surrounds_once(sides, axis, around, {}) == expected);  // it forgets the one before
    }
    ++count[expected ? 1 : 0];
  }
  CHECK(count[0] > 500);
  CHECK(count[1] > 500);
}

}  // namespace
}  // namespace nef::test
