// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/export/to_mesh.h"
#include "nef/geometry/search/spatial_order.h"
#include "tests/support/literals.h"

namespace nef::test {

TEST_CASE("A rounded mesh is the exact one with every coordinate rounded once") {
  for (const char* text : {"box(0,0,0,1,1,1)", "box(0,0,0,3,3,3) - box(1,1,1,2,2,4) + hull(5,5,5, 6,5,5, 5,7,5, 5,5,8)",
                           "hull(0,0,0, 7,1,0, 2,9,1, 3,1,8) + hull(1,1,1, 8,2,1, 3,7,3, 1,2,9) - box(1,1,1,2,2,4)",
                           "hull(1/3,0,0, 1e20,1,0, 2,1/7,1, 3,1,1e-300) - hull(1,1,1, 8,2,1, 3,7,3, 1,2,1/9)",
                           "interior(box(0,0,0,1,1,1)) + halfspace(0,0,1,9)"}) {
    CAPTURE(text);
    const Polyhedron solid = set(text);
    for (const bool polygons : {false, true}) {
      MeshExportOptions options;
      options.keep_polygons = polygons;
      const MeshExport exact = to_mesh(solid, options);
      const RoundedMeshExport rounded = to_rounded_mesh(solid, options);
      CHECK(rounded.lost == exact.lost);
      CHECK(rounded.mesh.face_begin == exact.mesh.face_begin);
      CHECK(rounded.mesh.corners == exact.mesh.corners);
      REQUIRE(rounded.mesh.vertices.size() == exact.mesh.vertices.size());
      for (std::size_t v = 0; v < exact.mesh.vertices.size(); ++v) {
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(rounded.mesh.vertices[v][i] == nearest_double(exact.mesh.vertices[v][i]));
          CHECK(std::signbit(rounded.mesh.vertices[v][i]) == (exact.mesh.vertices[v][i] < 0));  // no -0
        }
      }
    }
  }
}

namespace {

std::vector<std::uint32_t> along_curve(const std::vector<std::array<double, 3>>& points, unsigned threads = 1) {
  std::vector<std::uint32_t> order;
  for (const SpatialKey& key : spatial_keys(points, Monitor().on_threads(threads))) order.push_back(key.index);
  return order;
}

}  // namespace

TEST_CASE("The spatial order is a permutation in which octants stay together") {
  std::vector<std::array<double, 3>> points;
  for (unsigned i = 0; i < 512; ++i) {
    const unsigned k = i * 293 % 512;
    points.push_back({static_cast<double>(k & 7U), static_cast<double>(k >> 3U & 7U), static_cast<double>(k >> 6U)});
  }
  const std::vector<std::uint32_t> order = along_curve(points);
  std::vector<bool> seen(points.size(), false);
  for (const std::uint32_t v : order) seen[v] = true;
  CHECK(std::count(seen.begin(), seen.end(), true) == 512);
  for (std::size_t block = 0; block < 8; ++block) {
    for (std::size_t i = 0; i < 64; ++i) {
      const auto& p = points[order[64 * block + i]];
      CHECK((p[0] >= 4 ? 1U : 0U) + (p[1] >= 4 ? 2U : 0U) + (p[2] >= 4 ? 4U : 0U) == block);
    }
  }
  CHECK(along_curve({}).empty());
  const std::vector<std::array<double, 3>> same(5, {1, 2, 3});
  CHECK(along_curve(same) == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  const std::vector<std::array<double, 3>> far{{HUGE_VAL, 0, 0}, {1e300, -1e300, 0}, {-1e300, 0, 0}};
  CHECK(along_curve(far).back() == 0);
}

TEST_CASE("Points are sorted along the curve alike on any number of threads") {
  std::mt19937 random(5);
  std::vector<std::array<double, 3>> points(20000);  // many of them several times
  for (auto& point : points) {
    for (double& x : point) x = static_cast<double>(random() % 16);
  }
  points[7] = {HUGE_VAL, 0, 0};
  const std::vector<std::uint32_t> order = along_curve(points);
  for (const unsigned threads : {2U, 3U, 8U, 0U}) CHECK(along_curve(points, threads) == order);
}

}  // namespace nef::test
