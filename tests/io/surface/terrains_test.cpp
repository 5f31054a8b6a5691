// SPDX-License-Identifier: Apache-2.0
//
// What is found to be a terrain, against sets made of its triangles.
#include "nef/mesh/surface/terrains.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/common_corners.h"

namespace nef::test {
namespace {

using Triangle = VertexStars::Triangle;

constexpr std::uint32_t kSize = 4;                                           // points along a side of a grid
constexpr std::size_t kOfGrid = std::size_t{2} * (kSize - 1) * (kSize - 1);  // triangles

// A grid of triangles over the plane of two axes, with random heights along the third.
std::vector<Rational3> landscape(std::mt19937& random, std::size_t axis) {
  std::vector<Rational3> places(std::size_t{kSize} * kSize + 1);
  for (std::size_t i = 0; i < 3; ++i) places.back()[i] = i == axis ? -100 : 3;
  for (std::uint32_t i = 0; i < kSize; ++i) {
    for (std::uint32_t j = 0; j < kSize; ++j) {
      Rational3& place = places[i * kSize + j];
      place[axis] = static_cast<int>(random() % 7);
      place[(axis + 1) % 3] = 2 * i;
      place[(axis + 2) % 3] = 2 * j;
    }
  }
  return places;
}

// The triangles of the grid, and behind them those that join its border to one more point, as sides that do not close
// are nobody's inner ones.
std::vector<Triangle> closed_grid() {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 1 < kSize; ++i) {
    for (std::uint32_t j = 0; j + 1 < kSize; ++j) {
      const std::uint32_t low = i * kSize + j;
      triangles.push_back({low, low + kSize, low + kSize + 1});
      triangles.push_back({low, low + kSize + 1, low + 1});
    }
  }
  constexpr std::uint32_t kLast = kSize - 1;
  for (std::uint32_t i = 0; i < kLast; ++i) {
    const std::uint32_t apex = kSize * kSize;
    triangles.push_back({(i + 1) * kSize, i * kSize, apex});
    triangles.push_back({kLast * kSize + i + 1, kLast * kSize + i, apex});
    triangles.push_back({i * kSize + kLast, (i + 1) * kSize + kLast, apex});
    triangles.push_back({i, i + 1, apex});
  }
  return triangles;
}

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> result(count);
  std::iota(result.begin(), result.end(), 0U);
  return result;
}

TEST_CASE("Height fields are terrains from either side") {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Rational3> places = landscape(random, static_cast<std::size_t>(round % 3));
    std::vector<Triangle> triangles = closed_grid();
    if (round % 2 == 0) {
      for (Triangle& t : triangles) std::swap(t[1], t[2]);
    }
    const MeshPoints points(places);
    const VertexStars stars(points, triangles, Monitor());
    Terrains terrains(points, stars, triangles, {});
    CHECK(terrains.is_terrain(numbers(kOfGrid)));
    CHECK_FALSE(terrains.is_terrain(numbers(triangles.size())));
  }
}

TEST_CASE("Triangles of a terrain meet in nothing but what they share") {
  std::mt19937 random(2);
  std::array<int, 2> count{};
  for (int round = 0; round < 1000; ++round) {
    // Points pulled aside, so that the grid may fold or meet what closes it.
    std::vector<Rational3> places = landscape(random, static_cast<std::size_t>(round % 3));
    for (unsigned moved = random() % 4; moved > 0; --moved) {
      Rational3& place = places[random() % places.size()];
      for (Rational& x : place) x += static_cast<int>(random() % 9) - 4;
    }
    const std::vector<Triangle> triangles = closed_grid();
    const MeshPoints points(places);
    if (std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
          return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || points.collinear(t[0], t[1], t[2], {});
        })) {
      continue;
    }
    const VertexStars stars(points, triangles, Monitor());
    Terrains terrains(points, stars, triangles, {});
    std::vector<std::uint32_t> asked = numbers(random() % 3 == 0 ? triangles.size() : kOfGrid);
    std::shuffle(asked.begin(), asked.end(), random);
    asked.resize(4 + random() % (kOfGrid - 4));
    const bool found = terrains.is_terrain(asked);
    ++count[found ? 1 : 0];
    for (std::size_t i = 0; found && i < asked.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        CHECK(meet_in_common_corners_only(places, triangles[asked[i]], triangles[asked[j]]));
      }
    }
  }
  CHECK(count[0] > 50);
  CHECK(count[1] > 50);
}

}  // namespace
}  // namespace nef::test
