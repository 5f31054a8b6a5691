// SPDX-License-Identifier: Apache-2.0
//
// What is said of the triangles around vertices, against sets made of the triangles, and against lists of their edges.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "nef/construct/construct.h"
#include "nef/mesh/surface/vertex_stars.h"
#include "nef/polyhedron.h"
#include "tests/support/common_corners.h"

namespace nef::test {
namespace {

using Triangle = VertexStars::Triangle;

bool degenerate(const MeshPoints& points, const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || points.collinear(t[0], t[1], t[2], {});
}

Rational3 random_place(std::mt19937& random, int size, bool near_plane) {
  const auto coordinate = [&](int limit) {
    return Rational(static_cast<int>(random() % static_cast<unsigned>(2 * limit + 1)) - limit);
  };
  return {coordinate(size), coordinate(size), coordinate(near_plane ? 1 : size)};
}

TEST_CASE("Triangles around a flat vertex meet in nothing but what they share") {
  std::mt19937 random(20);
  std::size_t settled = 0;
  std::size_t open = 0;
  for (int round = 0; round < 150; ++round) {
    std::vector<Rational3> places{{0, 0, 0}};
    const std::uint32_t count = 3 + static_cast<std::uint32_t>(random() % 4);
    for (std::uint32_t i = 0; i < count; ++i) places.push_back(random_place(random, 3, round % 3 != 0));
    if (round % 2 == 0) {
      // Once around the axis as a rule, so that there is something to settle.
      std::sort(places.begin() + 1, places.end(), [](const Rational3& a, const Rational3& b) {
        return std::atan2(a[1].get_d(), a[0].get_d()) < std::atan2(b[1].get_d(), b[0].get_d());
      });
    }
    const MeshPoints points(places);
    std::vector<Triangle> fan;
    for (std::uint32_t i = 0; i < count; ++i) fan.push_back({0, 1 + i, 1 + (i + 1) % count});
    if (std::any_of(fan.begin(), fan.end(), [&](const Triangle& t) { return degenerate(points, t); })) continue;
    const VertexStars stars(points, fan, Monitor());
    for (std::size_t i = 0; i < fan.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        (stars.settle(fan[i], fan[j]) ? settled : open) += 1;
        if (stars.settle(fan[i], fan[j])) CHECK(meet_in_common_corners_only(places, fan[i], fan[j]));
      }
    }
  }
  CHECK(settled > 100);
  CHECK(open > 100);
}

TEST_CASE("All vertices are closed if each edge has a face on either side and no two faces have the same corners") {
  std::mt19937 random(7);
  std::size_t closed = 0;
  for (int round = 0; round < 3000; ++round) {
    // The faces of an octahedron, or of two tetrahedra with a common vertex; some turned, moved or taken away.
    std::vector<Triangle> triangles;
    if (round % 2 == 0) {
      for (const std::uint32_t pole : {4U, 5U}) {
        for (std::uint32_t i = 0; i < 4; ++i) {
          const std::uint32_t j = (i + 1) % 4;
          triangles.push_back(pole == 4 ? Triangle{i, j, pole} : Triangle{j, i, pole});
        }
      }
    } else {
      triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
    }
    for (int changes = static_cast<int>(random() % 3); changes > 0; --changes) {
      Triangle& t = triangles[random() % triangles.size()];
      switch (random() % 4) {
        case 0:
          std::swap(t[0], t[1]);
          break;
        case 1:
          t[random() % 3] = static_cast<std::uint32_t>(random() % 6);
          break;
        case 2:
          triangles.push_back({t[1], t[0], t[2]});
          break;
        default:
          std::rotate(t.begin(), t.begin() + 1, t.end());
      }
    }
    std::vector<Rational3> places;
    for (int i = 0; i < 7; ++i) places.push_back({i, i * i, i * i * i});  // no three on a line
    const MeshPoints points(places);
    if (std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return degenerate(points, t); })) {
      continue;
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    std::set<std::set<std::uint32_t>> faces;
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
      faces.insert({t[0], t[1], t[2]});
    }
    bool expected = faces.size() == triangles.size();
    for (const auto& [edge, count] : uses)
      expected = expected && count == 1 && uses.count({edge.second, edge.first}) == 1;
    CHECK(VertexStars(points, triangles, Monitor()).all_closed() == expected);
    closed += expected ? 1 : 0;
  }
  CHECK(closed > 100);
}

TEST_CASE("A vertex of very many triangles is closed and flat like others") {
  constexpr std::uint32_t kCount = 40;
  std::vector<Rational3> places{{0, 0, 5}, {0, 0, -5}};
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kCount;
    places.push_back({std::round(1000 * std::cos(angle)), std::round(1000 * std::sin(angle)), 0});
  }
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    triangles.push_back({0, 2 + i, 2 + (i + 1) % kCount});
    triangles.push_back({1, 2 + (i + 1) % kCount, 2 + i});
  }
  const MeshPoints points(places);
  const VertexStars stars(points, triangles, Monitor());
  CHECK(stars.all_closed());
  CHECK(stars.settle(triangles[0], triangles[2 * (kCount / 2)]));
  triangles.push_back(triangles.back());
  CHECK_FALSE(VertexStars(points, triangles, Monitor()).all_closed());
}

}  // namespace
}  // namespace nef::test
