// SPDX-License-Identifier: Apache-2.0
//
// Pieces of polygons: convex, turned like the polygon, side by side without gaps, as large as the polygon together, and
// no two that could be one.
#include "apps/minkowski/convolution/facets/convex_pieces.h"

#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace nef::minkowski {
namespace {

using Ring = std::vector<std::uint32_t>;
using Sides = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;  // from, to: how often
constexpr std::size_t kMostCorners = 96;

// Points in the plane z = 0, and the rings of a polygon on them.
struct Polygon {
  std::vector<Rational3> points;
  std::vector<Ring> rings;

  void add_ring(const std::vector<std::array<long, 2>>& corners) {
    Ring& ring = rings.emplace_back();
    for (const auto& [x, y] : corners) {
      ring.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({x, y, 0});
    }
  }

  [[nodiscard]] Rational twice_area(const Ring& ring) const {
    Rational sum;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Rational3& p = points[ring[i]];
      const Rational3& q = points[ring[(i + 1) % ring.size()]];
      sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
  }

  // The sine of the turn at a corner, times lengths.
  [[nodiscard]] Rational turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return (points[b][0] - points[a][0]) * (points[c][1] - points[b][1]) -
           (points[b][1] - points[a][1]) * (points[c][0] - points[b][0]);
  }

  [[nodiscard]] bool is_convex(const Ring& ring) const {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (turn(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0) return false;
    }
    return n >= 3;
  }
};

Sides sides_of(const std::vector<Ring>& rings) {
  Sides result;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) ++result[{ring[i], ring[(i + 1) % ring.size()]}];
  }
  return result;
}

// Two pieces with a side in common, as one ring.
Ring together(const Ring& a, std::size_t i, const Ring& b, std::size_t j) {
  Ring result;
  for (std::size_t k = 1; k <= a.size(); ++k) result.push_back(a[(i + k) % a.size()]);
  for (std::size_t k = 2; k < b.size(); ++k) result.push_back(b[(j + k) % b.size()]);
  return result;
}

void no_two_are_one(const Polygon& polygon, const std::vector<Ring>& pieces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> place;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t i = 0; i < pieces[p].size(); ++i) {
      place[{pieces[p][i], pieces[p][(i + 1) % pieces[p].size()]}] = {p, i};
    }
  }
  for (const auto& [side, at] : place) {
    const auto across = place.find({side.second, side.first});
    if (across == place.end()) continue;
    const auto& [q, j] = across->second;
    CHECK_FALSE(polygon.is_convex(together(pieces[at.first], at.second, pieces[q], j)));
  }
}

// Corners that are not straight: of those, a piece has few.
std::size_t turns_in(const Polygon& polygon, const Ring& ring) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (polygon.turn(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) != 0) ++count;
  }
  return count;
}

// Cuts it and checks all; true if pieces were cut for their size.
bool check_pieces(const Polygon& polygon) {
  const MeshPoints points(polygon.points);
  const std::vector<Ring> pieces = ConvexPieces(points, {}).cut(polygon.rings, {2, 1});
  Rational whole;
  for (const Ring& ring : polygon.rings) whole += polygon.twice_area(ring);
  Rational sum;
  bool is_large = false;
  for (const Ring& piece : pieces) {
    CHECK(polygon.is_convex(piece));
    CHECK(polygon.twice_area(piece) > 0);
    CHECK(turns_in(polygon, piece) <= kMostCorners);
    is_large = is_large || piece.size() > kMostCorners / 4;
    sum += polygon.twice_area(piece);
  }
  CHECK(sum == whole);
  // What is no side of the polygon has a piece on both sides.
  Sides inner = sides_of(pieces);
  for (const auto& [side, count] : inner) CHECK(count == 1);
  for (const auto& [side, count] : sides_of(polygon.rings)) CHECK(inner.erase(side) == count);
  for (const auto& [side, count] : inner) CHECK(inner.count({side.second, side.first}) == 1);
  if (!is_large) no_two_are_one(polygon, pieces);
  return is_large;
}

// Corners on a large circle, rounded: strictly convex.
std::vector<std::array<long, 2>> circle(std::size_t corners, double radius, bool clockwise = false) {
  std::vector<std::array<long, 2>> result;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(corners) * (clockwise ? -1 : 1);
    result.push_back({std::lround(radius * std::cos(angle)), std::lround(radius * std::sin(angle))});
  }
  return result;
}

TEST_CASE("convex pieces of a polygon of any shape") {
  CHECK(rc::check("stars", [] {
    Polygon star;
    const auto corners = *rc::gen::inRange<std::size_t>(3, 40);
    std::vector<std::array<long, 2>> outline;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(corners);
      const double radius = 10 * *rc::gen::inRange(10, 100);
      outline.push_back({std::lround(radius * std::cos(angle)), std::lround(radius * std::sin(angle))});
    }
    star.add_ring(outline);
    if (*rc::gen::arbitrary<bool>()) star.add_ring(circle(*rc::gen::inRange<std::size_t>(3, 9), 30, true));
    check_pieces(star);
  }));
}

TEST_CASE("straight corners stay corners of pieces on both sides") {
  Polygon letter;
  letter.add_ring({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}});
  check_pieces(letter);
  Polygon frame;
  frame.add_ring({{0, 0}, {3, 0}, {6, 0}, {6, 6}, {0, 6}});
  frame.add_ring({{2, 2}, {2, 4}, {4, 4}, {4, 2}});
  check_pieces(frame);
}

TEST_CASE("pieces of very many corners are cut further") {
  for (const std::size_t corners : {97U, 128U, 1000U, 5000U}) {
    Polygon disk;
    disk.add_ring(circle(corners, 1e9));
    CHECK(check_pieces(disk));
    disk.add_ring(circle(5, 1e8, true));
    check_pieces(disk);
  }
  // Half a disk on a side with many straight corners.
  Polygon half;
  std::vector<std::array<long, 2>> outline = circle(2000, 1e9);
  outline.resize(1001);
  for (long x = -999; x < 1000; ++x) outline.push_back({x * 1'000'000, 0});
  half.add_ring(outline);
  check_pieces(half);
}

}  // namespace
}  // namespace nef::minkowski
