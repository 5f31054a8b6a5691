// SPDX-License-Identifier: Apache-2.0
//
// Damaged in known ways, meshes become the solid they were.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/import/repair.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

Mesh mesh_of(const Polyhedron& set) { return to_mesh(set).mesh; }

Mesh changed(const Mesh& mesh, const std::function<void(std::vector<std::vector<std::uint32_t>>&)>& change) {
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) rings.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  change(rings);
  Mesh result;
  result.vertices = mesh.vertices;
  for (const auto& ring : rings) result.push_face(ring);
  return result;
}

void check_repaired(const Mesh& mesh, const Polyhedron& wanted, const RepairOptions& options = {}) {
  const RepairedMesh repaired = repair_mesh(mesh, options);
  INFO(repaired.problem);
  REQUIRE(repaired.problem.empty());
  CHECK(equal(from_mesh(repaired.mesh), wanted));
}

}  // namespace

TEST_CASE("A sound mesh is left alone", "[repair]") {
  const Mesh mesh = mesh_of(make_box({0, 0, 0}, {1, 2, 3}));
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(repaired.done.empty());
  CHECK(repaired.problem.empty());
  CHECK(repaired.mesh.corners == mesh.corners);
}

TEST_CASE("Faces that are turned at random, doubled, and components turned over", "[repair]") {
  const Polyhedron hollow = regularize(subtract(make_box({0, 0, 0}, {9, 9, 9}), make_box({2, 2, 2}, {5, 5, 5})));
  const Polyhedron set = unite(unite(hollow, make_box({3, 3, 3}, {4, 4, 4})), make_box({11, 0, 0}, {12, 1, 1}));
  const Mesh mesh = mesh_of(set);
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const Mesh damaged = changed(mesh, [&](auto& rings) {
      for (std::size_t f = 0, n = rings.size(); f < n; ++f) {
        if (random() % 2 == 0) std::reverse(rings[f].begin(), rings[f].end());
        if (random() % 4 == 0) {
          rings.push_back(rings[f]);
          if (random() % 2 == 0) std::reverse(rings.back().begin(), rings.back().end());
        }
      }
    });
    check_repaired(damaged, set);
  }
}

// Unit cubes of a 3 x 3 x 3 grid, each with all of its six faces, so that neighbours share walls of two faces.
namespace {

Mesh cubes_with_walls(const std::vector<std::array<int, 3>>& cells) {
  Mesh mesh;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int z = 0; z < 4; ++z) mesh.vertices.push_back({x, y, z});
    }
  }
  for (const std::array<int, 3>& cell : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int end = 0; end < 2; ++end) {
        std::vector<std::uint32_t> ring;
        for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
          std::array<int, 3> corner = cell;
          corner[static_cast<std::size_t>(axis)] += end;
          corner[static_cast<std::size_t>((axis + 1) % 3)] += i;
          corner[static_cast<std::size_t>((axis + 2) % 3)] += j;
          ring.push_back(static_cast<std::uint32_t>(16 * corner[0] + 4 * corner[1] + corner[2]));
        }
        if (end == 0) std::reverse(ring.begin(), ring.end());
        mesh.push_face(ring);
      }
    }
  }
  return mesh;
}

Polyhedron union_of(const std::vector<std::array<int, 3>>& cells) {
  std::vector<Polyhedron> boxes;
  for (const auto& [x, y, z] : cells) boxes.push_back(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
  return unite_all(boxes);
}

// Doubles or turns some faces.
Mesh with_faces_damaged(const Mesh& mesh, std::mt19937& random, std::size_t count) {
  return changed(mesh, [&](auto& rings) {
    for (std::size_t i = 0; i < count; ++i) {
      auto& ring = rings[random() % (mesh.face_count())];
      const auto kind = random() % 3;
      if (kind == 0) {
        std::reverse(ring.begin(), ring.end());
        continue;
      }
      std::vector<std::uint32_t> copy = ring;
      std::rotate(copy.begin(), copy.begin() + static_cast<std::ptrdiff_t>(random() % copy.size()), copy.end());
      if (kind == 1) std::reverse(copy.begin(), copy.end());
      rings.push_back(std::move(copy));
    }
  });
}

}  // namespace

TEST_CASE("A wall between solids stays when a face elsewhere is doubled or turned", "[repair]") {
  const std::vector<std::array<int, 3>> two{{0, 0, 0}, {1, 0, 0}};
  const Mesh mesh = cubes_with_walls(two);
  CHECK(equal(from_mesh(mesh), make_box({0, 0, 0}, {2, 1, 1})));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const bool doubles : {true, false}) {
      for (const bool turns : {true, false}) {
        if (!doubles && !turns) continue;
        CAPTURE(f, doubles, turns);
        const Mesh damaged = changed(mesh, [&](auto& rings) {
          if (doubles) rings.push_back(rings[f]);
          if (turns) std::reverse(rings[f].begin(), rings[f].end());
        });
        check_repaired(damaged, make_box({0, 0, 0}, {2, 1, 1}));
      }
    }
  }
}

TEST_CASE("Blocks of cubes with all their walls are repaired", "[repair]") {
  std::mt19937 random(11);
  std::vector<std::array<int, 3>> all;
  for (int i = 0; i < 27; ++i) all.push_back({i / 9, i / 3 % 3, i % 3});
  check_repaired(with_faces_damaged(cubes_with_walls(all), random, 3), make_box({0, 0, 0}, {3, 3, 3}));
  for (int round = 0; round < 40; ++round) {
    // A stack in each column is a body without edges of four faces but for those of walls.
    std::vector<std::array<int, 3>> cells;
    const int layers = 1 + static_cast<int>(random() % 3);
    for (int x = 0; x < 3; ++x) {
      const int depth = 1 + static_cast<int>(random() % 3);
      for (int y = 0; y < depth; ++y) {
        for (int z = 0; z < layers; ++z) cells.push_back({x, y, z});
      }
    }
    CAPTURE(round, cells);
    check_repaired(with_faces_damaged(cubes_with_walls(cells), random, 1 + random() % 3), union_of(cells));
  }
}

TEST_CASE("T-junctions close, with slivers and without", "[repair]") {
  // The front of a box has a vertex in the middle of its upper edge, the top has not.
  const char* vertices = "0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 4\n4 0 4\n4 4 4\n0 4 4\n2 0 4\n";
  const std::string faces = "4 0 3 2 1\n5 0 1 5 8 4\n4 4 5 6 7\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const Mesh open = read_off(std::string("OFF\n9 6 0\n") + vertices + faces, "t.off");
  CHECK_THROWS_AS(from_mesh(open), InputError);
  check_repaired(open, make_box({0, 0, 0}, {4, 4, 4}));
  const Mesh turned = read_off(std::string("OFF\n9 7 0\n") + vertices + faces + "3 4 5 8\n", "t.off");
  check_repaired(turned, make_box({0, 0, 0}, {4, 4, 4}));
}

TEST_CASE("Planar holes are filled when asked", "[repair]") {
  const Polyhedron set = unite(make_box({0, 0, 0}, {4, 4, 4}), make_box({1, 1, 4}, {2, 2, 6}));
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  const Mesh mesh = to_mesh(set, polygons).mesh;
  const Mesh open = changed(mesh, [](auto& rings) { rings.erase(rings.begin()); });
  CHECK_FALSE(repair_mesh(open).problem.empty());
  RepairOptions fill;
  fill.fill_holes = true;
  check_repaired(open, set, fill);
}

TEST_CASE("What can not be repaired is told", "[repair]") {
  const Mesh crossing = read_off(
      "OFF\n8 8 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 -1\n5 1 -1\n1 5 -1\n1 1 3\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n",
      "x.off");
  CHECK(repair_mesh(crossing).problem.find("cross") != std::string::npos);
}

}  // namespace nef
