// SPDX-License-Identifier: Apache-2.0
//
// Lids against all triangulations of small loops; borders against the balance of sides, counted here.
#include "nef/import/repair/lids.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "nef/geometry/vectors.h"

namespace nef {
namespace {

using Rings = std::vector<std::vector<std::uint32_t>>;

std::vector<Rational3> random_places(std::mt19937& random, std::size_t count, unsigned size) {
  std::vector<Rational3> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(
        {static_cast<long>(random() % size), static_cast<long>(random() % size), static_cast<long>(random() % size)});
  }
  return result;
}

double area_of_triangle(const Rational3& a, const Rational3& b, const Rational3& c) {
  const Rational3 normal = cross(minus(b, a), minus(c, a));
  return std::sqrt(dot(normal, normal).get_d()) / 2;
}

// The least sum of areas, by trying all triangles over the last side and all triangulations of what they leave.
double least_of_all(const std::vector<Rational3>& p, std::size_t first, std::size_t last) {
  if (last - first < 2) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = first + 1; m < last; ++m) {
    least = std::min(least,
                     least_of_all(p, first, m) + least_of_all(p, m, last) + area_of_triangle(p[first], p[m], p[last]));
  }
  return least;
}

// Sides with how often they are run through from the smaller vertex to the larger one, less the way back; without
// zeros.
std::map<std::set<std::uint32_t>, int> balance(const Rings& rings) {
  std::map<std::set<std::uint32_t>, int> result;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t u = ring[i];
      const std::uint32_t v = ring[(i + 1) % ring.size()];
      result[{u, v}] += u < v ? 1 : -1;
    }
  }
  for (auto at = result.begin(); at != result.end();) at = at->second == 0 ? result.erase(at) : std::next(at);
  return result;
}

}  // namespace

TEST_CASE("Triangles of a loop have the least area and its border", "[lids]") {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 3 + random() % 7;
    const std::vector<Rational3> places = random_places(random, n, 40);
    std::vector<std::uint32_t> loop;
    for (std::uint32_t v = 0; v < n; ++v) loop.push_back(v);
    const Rings triangles = least_area_triangles(places, loop);
    CAPTURE(round, n);
    REQUIRE(triangles.size() == n - 2);
    CHECK(balance(triangles) == balance({loop}));
    double area = 0;
    for (const auto& t : triangles) area += area_of_triangle(places[t[0]], places[t[1]], places[t[2]]);
    CHECK(area == Approx(least_of_all(places, 0, n - 1)));
  }
}

TEST_CASE("Long loops lose ears first, and have their border still", "[lids]") {
  // A circle of 1500 corners that bends up and down: its lid is about as large as the disc.
  std::vector<Rational3> places;
  std::vector<std::uint32_t> loop;
  constexpr int kCorners = 1500;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / kCorners;
    places.push_back({Rational(std::cos(angle)), Rational(std::sin(angle)), Rational(std::cos(3 * angle) / 20)});
    loop.push_back(static_cast<std::uint32_t>(i));
  }
  const Rings triangles = least_area_triangles(places, loop);
  CHECK(triangles.size() == kCorners - 2);
  CHECK(balance(triangles) == balance({loop}));
  double area = 0;
  for (const auto& t : triangles) area += area_of_triangle(places[t[0]], places[t[1]], places[t[2]]);
  CHECK(area > 3.1);
  CHECK(area < 3.4);
}

TEST_CASE("Loops of the border balance all sides, each vertex once in a loop", "[lids]") {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const auto vertices = static_cast<std::uint32_t>(4 + random() % 8);
    Rings rings;
    for (std::size_t f = 0, n = 1 + random() % 12; f < n; ++f) {
      std::vector<std::uint32_t> ring;
      while (ring.size() < 3 + f % 2) {
        const auto v = static_cast<std::uint32_t>(random() % vertices);
        if (std::find(ring.begin(), ring.end(), v) == ring.end()) ring.push_back(v);
      }
      rings.push_back(ring);
    }
    CAPTURE(round, rings);
    Rings all = rings;
    for (const auto& loop : border_loops(rings)) {
      CHECK(loop.size() >= 3);
      CHECK(std::set<std::uint32_t>(loop.begin(), loop.end()).size() == loop.size());
      all.push_back(loop);
    }
    CHECK(balance(all).empty());
    // Any lids close it as well.
    const Lids lids = lids_for(random_places(random, vertices, 9), rings, LidShape::kAny, {});
    Rings closed = rings;
    closed.insert(closed.end(), lids.faces.begin(), lids.faces.end());
    CHECK(balance(closed).empty());
    CHECK(lids.share >= 0);
    CHECK(lids.share <= 1);
  }
}

TEST_CASE("A crack between two parts has a loop for each of its slits", "[lids]") {
  // A square, and from below an octagon with the same corners: with the others, 4 to 7, it leaves four slits.
  const Rings loops = border_loops({{0, 1, 2, 3}, {0, 4, 3, 7, 2, 6, 1, 5}});
  CHECK(loops.size() == 4);
  for (const auto& loop : loops) CHECK(loop.size() == 3);
  // Of several turns at a vertex, each loop takes the shortest way back.
  CHECK(border_loops({{0, 1, 2}, {0, 3, 4, 5}}).size() == 2);
}

}  // namespace nef
