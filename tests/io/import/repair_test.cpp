// SPDX-License-Identifier: Apache-2.0
//
// Damaged in known ways, meshes become the solid they were.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/import/repair.h"
#include "nef/import/repair/signed_volume.h"
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

// The meshes of some solids as one.
Mesh together(const std::vector<Polyhedron>& sets) {
  Mesh result;
  for (const Polyhedron& set : sets) {
    const Mesh mesh = mesh_of(set);
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<std::uint32_t> ring;
      for (const std::uint32_t v : mesh.face(f)) ring.push_back(first + v);
      result.push_face(ring);
    }
  }
  return result;
}

// Turns the faces from `first` on.
Mesh turned_over(const Mesh& mesh, std::size_t first) {
  return changed(mesh, [&](auto& rings) {
    for (std::size_t f = first; f < rings.size(); ++f) std::reverse(rings[f].begin(), rings[f].end());
  });
}

constexpr RepairOptions kUniting{.crossings = Crossings::kUnion};

}  // namespace

TEST_CASE("an inner wall goes by the rule outside, and the solid is written without it") {
  // Two rooms with one wall between them, whose edges have three faces.
  Mesh rooms;
  for (const int z : {0, 1, 2}) {
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      rooms.vertices.push_back({x, y, z});
    }
  }
  for (const std::uint32_t below : {0U, 4U}) {
    for (const std::uint32_t i : {0U, 1U, 2U, 3U}) {
      const std::uint32_t next = below + (i + 1) % 4;
      rooms.push_face(std::vector<std::uint32_t>{below + i, next, next + 4, below + i + 4});
    }
  }
  rooms.push_face(std::vector<std::uint32_t>{3, 2, 1, 0});
  rooms.push_face(std::vector<std::uint32_t>{8, 9, 10, 11});
  CHECK(equal(from_mesh(rooms), make_box({0, 0, 0}, {1, 1, 2})));
  rooms.push_face(std::vector<std::uint32_t>{4, 5, 6, 7});
  const Polyhedron wanted = make_box({0, 0, 0}, {1, 1, 2});
  const Messages decided{"edges with an odd number of faces; selected points that cannot be reached from outside"};
  const RepairedMesh repaired = repair_mesh(rooms, {.crossings = Crossings::kOutside});
  CHECK(repaired.problem.empty());
  CHECK(repaired.done == decided);
  REQUIRE(repaired.resolved);
  CHECK(equal(repaired.resolved->set, wanted));
  Messages notes;
  CHECK(equal(from_mesh(rooms, {.crossings = Crossings::kOutside}, &notes), wanted));
  CHECK(notes == decided);
  // With the other rules it is refused.
  CHECK_FALSE(repair_mesh(rooms, {.crossings = Crossings::kUnion}).problem.empty());
}

TEST_CASE("A sound mesh is left alone", "[repair]") {
  const Mesh mesh = mesh_of(make_box({0, 0, 0}, {1, 2, 3}));
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(repaired.done.empty());
  CHECK(repaired.problem.empty());
  CHECK(repaired.mesh.corners == mesh.corners);
}

TEST_CASE("Faces that are turned at random, doubled, and components flipped", "[repair]") {
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

TEST_CASE("A skin that was doubled stays where it touches another one in an edge or a vertex", "[repair]") {
  for (const Rational3& corner : {Rational3{1, 0, 1}, Rational3{1, 1, 0}, Rational3{1, 1, 1}, Rational3{3, 0, 0}}) {
    const Polyhedron a = make_box({0, 0, 0}, {1, 1, 1});
    const Polyhedron b = make_box(corner, {corner[0] + 1, corner[1] + 1, corner[2] + 1});
    check_repaired(together({a, b, b}), unite(a, b));
  }
}

TEST_CASE("Solids that share faces on the same side are no copies of each other", "[repair][crossings]") {
  const Polyhedron low = make_box({0, 0, 0}, {2, 2, 1});
  const Polyhedron high = make_box({0, 0, 0}, {2, 2, 3});
  const Polyhedron beside = make_box({2, 0, 0}, {4, 2, 1});
  const Polyhedron both = unite(high, beside);
  CHECK(equal(repair_mesh(together({low, high, beside}), kUniting).set, both));
  CHECK(equal(repair_mesh(together({low, low, high, beside}), kUniting).set, both));
  // A T-junction beside them: the middle of an edge of the bottom, in one face only.
  Mesh cut = together({low, high, beside});
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::size_t f = 0; f < cut.face_count(); ++f) rings.emplace_back(cut.face(f).begin(), cut.face(f).end());
  Rational3 middle;
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (cut.vertices[rings[0][0]][i] + cut.vertices[rings[0][1]][i]) / 2;
  rings[0].insert(rings[0].begin() + 1, static_cast<std::uint32_t>(cut.vertices.size()));
  Mesh damaged;
  damaged.vertices = cut.vertices;
  damaged.vertices.push_back(middle);
  for (const auto& ring : rings) damaged.push_face(ring);
  const RepairedMesh repaired = repair_mesh(damaged, kUniting);
  CHECK(repaired.problem.empty());
  CHECK(equal(repaired.set, both));
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

TEST_CASE("Faces that cross are resolved by the rule, and it is said what is counted how", "[repair][crossings]") {
  const Polyhedron a = make_box({0, 0, 0}, {2, 2, 2});
  const Polyhedron b = make_box({1, 1, 1}, {3, 3, 3});
  const Polyhedron apart = make_box({7, 0, 0}, {8, 1, 1});
  const std::size_t faces = mesh_of(a).face_count();

  const RepairedMesh both = repair_mesh(together({a, b}), kUniting);
  REQUIRE(both.resolved);
  CHECK(both.problem.empty());
  CHECK(equal(both.resolved->set, unite(a, b)));
  REQUIRE(both.done.size() == 2);
  CHECK(both.done[0].find("pairs of faces cross; selected points that are enclosed at least once") !=
        std::string::npos);
  CHECK(both.done[1] == "1 part (volume 1, 6.67 %) is enclosed twice and counts once");
  CHECK(both.resolved->volumes.at(2).measured.value == Approx(1));
  CHECK_FALSE(repair_mesh(together({a, b})).problem.empty());

  // What crosses nothing and is inside out is turned over, what crosses others is left as it is.
  const RepairedMesh three = repair_mesh(turned_over(together({a, b, apart}), 2 * faces), kUniting);
  REQUIRE(three.resolved);
  CHECK(three.done[0] == "1 component flipped");
  CHECK(equal(three.resolved->set, unite(unite(a, b), apart)));
  const RepairedMesh less = repair_mesh(turned_over(together({make_box({0, 0, 0}, {4, 4, 4}), b}), faces), kUniting);
  CHECK(less.resolved.has_value() == false);  // b lies in the other box: a cavity
  const RepairedMesh minus = repair_mesh(turned_over(together({make_box({0, 0, 0}, {5, 2, 2}), b}), faces), kUniting);
  REQUIRE(minus.resolved);
  CHECK(equal(minus.resolved->set, regularize(subtract(make_box({0, 0, 0}, {5, 2, 2}), b))));
  CHECK(minus.done.back() == "1 part (volume 6, 33.3 %) is inside out and is left out");

  // A skin that is doubled is dropped before faces are counted.
  const Mesh doubled = changed(together({a, b}), [](auto& rings) {
    for (std::size_t f = 0, n = rings.size(); f < n; ++f) rings.emplace_back(rings[f].rbegin(), rings[f].rend());
  });
  const RepairedMesh once = repair_mesh(doubled, kUniting);
  REQUIRE(once.resolved);
  CHECK(equal(once.resolved->set, unite(a, b)));
}

TEST_CASE("The signed volume of faces is the sum of winding numbers times volumes", "[repair][crossings]") {
  const Polyhedron a = make_box({0, 0, 0}, {2, 2, 2});
  const Polyhedron b = make_box({1, 1, 1}, {3, 3, Rational(10, 3)});
  const std::size_t faces = mesh_of(a).face_count();
  for (const bool turned : {false, true}) {
    const Mesh mesh = turned ? turned_over(together({a, b}), faces) : together({a, b});
    const Rational wanted = 8 + Rational(turned ? -28 : 28, 3);
    const MeasuredVolume signed_one = signed_volume(mesh);
    CHECK(abs(Rational(signed_one.value) - wanted) <= Rational(signed_one.error));
    CHECK(signed_one.error < 1e-12);
    const RepairedMesh repaired = repair_mesh(mesh, kUniting);
    REQUIRE(repaired.resolved);
    double sum = 0;
    for (const auto& [winding, entry] : repaired.resolved->volumes) sum += winding * entry.measured.value;
    CHECK(sum == Approx(repaired.signed_volume.value));
  }
  CHECK(signed_volume(Mesh()).value == 0);
}

// A box whose corners are moved, so that its faces lie in no plane, each listed from any of its corners. Between two
// corners of its top is another one at this height, which makes a notch.
Mesh bent_box(std::mt19937& random, const Rational& height, bool turned_over) {
  const auto little = [&] { return Rational(static_cast<long>(random() % 200) - 100, 1000); };
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back({Rational(i & 1U) + little(), Rational(i / 2 & 1U) + little(), Rational(i / 4) + little()});
  }
  mesh.vertices.push_back({Rational(1, 2) + little(), Rational(1, 3) + little(), height + little()});
  std::vector<std::vector<std::uint32_t>> rings{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 8, 4},
                                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 8, 5, 7, 6}};
  for (auto& ring : rings) {
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()), ring.end());
    if (turned_over) std::reverse(ring.begin(), ring.end());
    mesh.push_face(ring);
  }
  return mesh;
}

TEST_CASE("Bent faces are the same surface however their corners are listed", "[repair]") {
  std::mt19937 random(12);
  for (int round = 0; round < 40; ++round) {
    const Mesh mesh = bent_box(random, Rational(1, 2), false);
    const Mesh listed = changed(mesh, [&](auto& rings) {
      std::shuffle(rings.begin(), rings.end(), random);
      for (auto& ring : rings) {
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()), ring.end());
        std::reverse(ring.begin(), ring.end());
      }
    });
    CHECK(
        equal(from_mesh(listed, {.crossings = Crossings::kUnion}), from_mesh(mesh, {.crossings = Crossings::kUnion})));
  }
}

TEST_CASE("A mesh of bent faces that is flipped is what its solid was made of", "[repair][crossings]") {
  std::mt19937 random(13);
  for (int round = 0; round < 20; ++round) {
    const Mesh mesh = bent_box(random, Rational(-1, 2), true);  // the notch goes through the bottom
    const RepairedMesh repaired = repair_mesh(mesh, kUniting);
    REQUIRE(repaired.problem.empty());
    REQUIRE(repaired.resolved);
    CHECK(repaired.done.front() == "1 component flipped");
    CHECK(equal(from_mesh(repaired.mesh, {.crossings = Crossings::kUnion}), repaired.set));
    double sum = 0;
    for (const auto& [winding, entry] : repaired.resolved->volumes) sum += winding * entry.measured.value;
    CHECK(sum == Approx(repaired.signed_volume.value));
  }
}

TEST_CASE("A component that stands on another one is flipped", "[repair][crossings]") {
  const Polyhedron a = make_box({0, 0, 0}, {4, 4, 1});
  const Polyhedron b = make_box({1, 1, 1}, {2, 2, 2});
  const Mesh mesh = turned_over(together({a, b}), mesh_of(a).face_count());
  for (const RepairOptions& options : {RepairOptions(), kUniting}) check_repaired(mesh, unite(a, b), options);
}

TEST_CASE("A component inside of another one is a cavity if it is turned like one", "[repair][crossings]") {
  const Polyhedron outer = make_box({0, 0, 0}, {9, 9, 9});
  const Polyhedron inner = make_box({2, 2, 2}, {5, 5, 5});
  const std::size_t faces = mesh_of(outer).face_count();
  const RepairedMesh filled = repair_mesh(together({outer, inner}), kUniting);
  REQUIRE(filled.resolved);
  CHECK(equal(filled.resolved->set, outer));
  CHECK(filled.done.back() == "1 part (volume 27, 3.7 %) is enclosed twice and counts once");
  check_repaired(together({outer, inner}), regularize(subtract(outer, inner)));  // without a rule
  // With some faces turned, how it is turned says nothing.
  const Mesh mixed =
      changed(together({outer, inner}), [&](auto& rings) { std::reverse(rings[faces].begin(), rings[faces].end()); });
  check_repaired(mixed, regularize(subtract(outer, inner)), kUniting);
}

TEST_CASE("Soups of tetrahedra with faces turned and doubled become their union", "[repair][crossings]") {
  std::mt19937 random(5);
  int resolved = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Polyhedron> sets;
    while (sets.size() < 4) {
      std::vector<Rational3> corners;
      for (int i = 0; i < 4; ++i) {
        corners.push_back({static_cast<long>(random() % 1000), static_cast<long>(random() % 1000),
                           static_cast<long>(random() % 1000)});
      }
      const Polyhedron set = convex_hull(corners);
      const bool nested = std::any_of(sets.begin(), sets.end(), [&](const Polyhedron& other) {
        return subtract(set, other).is_empty() || subtract(other, set).is_empty();
      });
      if (set.is_regular() && !nested) sets.push_back(set);
    }
    const Mesh damaged = changed(together(sets), [&](auto& rings) {
      for (std::size_t f = 0, n = rings.size(); f < n; f += 4) {
        std::vector<std::uint32_t>& ring = rings[f + random() % 4];
        std::vector<std::uint32_t> copy = ring;
        if (random() % 2 == 0) std::reverse(ring.begin(), ring.end());
        if (random() % 2 == 0) rings.push_back(std::move(copy));
      }
    });
    CAPTURE(round);
    const RepairedMesh repaired = repair_mesh(damaged, kUniting);
    CHECK(repaired.problem == "");
    resolved += repaired.resolved ? 1 : 0;
    CHECK(equal(repaired.resolved ? repaired.resolved->set : from_mesh(repaired.mesh), regularize(unite_all(sets))));
  }
  CHECK(resolved > 20);
}

TEST_CASE("A surface that cannot be oriented is refused, unless the rule does not care", "[repair][crossings]") {
  // A Klein bottle: a figure of eight that goes around a ring and turns over on the way; a wall of eight
  // corners for each of twelve places along the ring, moved to a grid.
  constexpr std::uint32_t kAround = 12;
  constexpr std::uint32_t kEight = 8;
  Mesh bottle;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t k = 0; k < kEight; ++k) {
      const double u = 2 * M_PI * i / kAround;
      const double v = 2 * M_PI * (k + 0.5) / kEight;
      const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double z = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      Rational3& p = bottle.vertices.emplace_back();
      const std::array<double, 3> place{r * std::cos(u), r * std::sin(u), z};
      for (std::size_t c = 0; c < 3; ++c) p[c] = Rational(std::lround(1000 * place[c])) / 1000;
    }
  }
  const auto at = [](std::uint32_t i, std::uint32_t k) {
    k %= kEight;
    return i < kAround ? i * kEight + k : kEight - 1 - k;
  };
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t k = 0; k < kEight; ++k) {
      bottle.push_face(std::array{at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      bottle.push_face(std::array{at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  for (const Crossings rule : {Crossings::kRefuse, Crossings::kUnion, Crossings::kNonzero}) {
    for (const double percent : {0.0, 100.0}) {
      const RepairedMesh refused = repair_mesh(bottle, {.close_percent = percent, .crossings = rule, .record = true});
      CHECK_THAT(refused.problem,
                 Catch::StartsWith("the surface cannot be oriented: a way around it leads from face "));
      CHECK_THAT(advice_about(refused, percent), Catch::StartsWith("; --crossings odd or outside"));
      CHECK(refused.record.fates.size() == bottle.face_count());
    }
  }
  CHECK_THROWS_WITH(from_mesh(bottle, {.crossings = Crossings::kUnion, .close_percent = 10}),
                    Catch::Contains("cannot be oriented") && Catch::Contains("crossings=\"odd\""));
  const RepairedMesh odd = repair_mesh(bottle, {.crossings = Crossings::kOdd});
  REQUIRE(odd.problem.empty());
  const RepairedMesh outside = repair_mesh(bottle, {.crossings = Crossings::kOutside});
  REQUIRE(outside.problem.empty());
  CHECK(volume(odd.set) > 0);
  CHECK(subtract(odd.set, outside.set).is_empty());
  for (const Polyhedron& set : {odd.set, outside.set}) {
    CHECK(contains(set, {Rational(18, 5), 0, Rational(1, 100)}));  // in a loop of the eight
    CHECK_FALSE(contains(set, {3, 0, Rational(1, 2)}));            // between its loops
  }
}

TEST_CASE("Holes get lids if these are small", "[repair][lids]") {
  const Polyhedron cube = make_box({0, 0, 0}, {2, 2, 2});
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  const Mesh open = changed(to_mesh(cube, polygons).mesh, [](auto& rings) { rings.pop_back(); });
  const RepairedMesh kept = repair_mesh(open, {.close_percent = 10});
  CHECK_FALSE(kept.problem.empty());
  CHECK_FALSE(kept.has_lids);
  CHECK(kept.holes == 1);
  CHECK(kept.lid_share == Approx(1.0 / 6));
  const RepairedMesh closed = repair_mesh(open, {.close_percent = 17});
  CHECK(closed.has_lids);
  CHECK(closed.flat_holes == 1);
  CHECK(closed.done.back() == "1 hole closed by lids of 17 % of the area, 1 of them flat (a guess)");
  CHECK(equal(from_mesh(closed.mesh), cube));

  // A corner of a cube is missing: the least lid is the triangle, and the cube loses a tetrahedron.
  const Mesh corner = changed(mesh_of(cube), [](auto& rings) {
    rings.erase(std::remove_if(rings.begin(), rings.end(),
                               [](const auto& ring) { return std::find(ring.begin(), ring.end(), 0U) != ring.end(); }),
                rings.end());
  });
  const RepairedMesh cut = repair_mesh(corner, {.close_percent = 60});
  INFO(cut.problem);
  REQUIRE(cut.problem.empty());
  const Polyhedron less = from_mesh(cut.mesh);
  CHECK(subtract(less, cube).is_empty());
  CHECK(volume(less) < 8);
  CHECK(less.complex().vertex_count() == 7);

  // A sheet lies between its lid and itself.
  const Mesh sheet = read_off("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "sheet.off");
  CHECK(repair_mesh(sheet, {.close_percent = 100, .crossings = Crossings::kUnion}).problem ==
        "the faces of the mesh enclose nothing");
  const RepairedMesh flat = repair_mesh(sheet, {.close_percent = 10, .crossings = Crossings::kUnion});
  CHECK(flat.is_flat);
  CHECK_THAT(advice_about(flat, 10),
             Catch::Contains("no lid makes them enclose anything") && Catch::Contains("--as-surface"));
  CHECK_FALSE(repair_mesh(open, {.close_percent = 10}).is_flat);
}

TEST_CASE("Flat pieces beside others are left out, as no lid makes them enclose anything", "[repair][lids]") {
  const Polyhedron cube = make_box({0, 0, 0}, {2, 2, 2});
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  const Mesh whole = to_mesh(cube, polygons).mesh;
  const auto beside_a_plate = [](const Mesh& mesh, const std::vector<std::uint32_t>& more, int size = 9) {
    Mesh result = mesh;
    std::vector<std::uint32_t> plate = more;  // vertex 0 is the origin
    for (const Rational3& corner : {Rational3{size, 0, 1}, Rational3{size, size, 2}, Rational3{0, size, 1}}) {
      plate.push_back(static_cast<std::uint32_t>(result.vertices.size()));
      result.vertices.push_back(corner);
    }
    result.push_face(plate);
    return result;
  };
  // The plate is larger than the cube.
  const Mesh scene = beside_a_plate(whole, {});
  CHECK(scene.vertices[0] == Rational3{0, 0, 0});
  CHECK_THROWS_AS(from_mesh(scene, {.crossings = Crossings::kUnion}), InputError);
  const RepairedMesh kept = repair_mesh(scene, {.close_percent = 10, .crossings = Crossings::kUnion, .record = true});
  CHECK(kept.problem.empty());
  CHECK(equal(kept.set, cube));
  CHECK_FALSE(kept.has_lids);
  CHECK(kept.holes == 0);
  CHECK(kept.done == std::vector<std::string>{"1 flat piece (1 face) left out: no lid makes it enclose anything"});
  REQUIRE(kept.record.fates.size() == 7);
  CHECK(kept.record.fates[0] == FaceFate::kKept);
  CHECK(kept.record.fates[6] == FaceFate::kInside);
  Messages notes;
  CHECK(equal(from_mesh(scene, {.close_percent = 10}, &notes), cube));
  CHECK(notes == kept.done);

  // Lids of others have their share as if it were not there, and a corner in common makes no difference.
  const Mesh open = changed(whole, [](auto& rings) { rings.pop_back(); });
  for (const std::vector<std::uint32_t>& more : {std::vector<std::uint32_t>{}, std::vector<std::uint32_t>{0}}) {
    const Mesh two = beside_a_plate(beside_a_plate(open, more), more, 7);
    const RepairedMesh refused = repair_mesh(two, {.close_percent = 10});
    CHECK(refused.lid_share == Approx(1.0 / 6));
    CHECK_FALSE(refused.problem.empty());
    const RepairedMesh closed = repair_mesh(two, {.close_percent = 17});
    CHECK(equal(closed.set, cube));
    CHECK(closed.holes == 1);
  }
  // Nothing but plates.
  const Mesh plates = beside_a_plate(beside_a_plate({}, {}), {}, 7);
  CHECK_FALSE(repair_mesh(plates, {.close_percent = 100, .crossings = Crossings::kUnion}).problem.empty());
}

TEST_CASE("Flat walls stay where what they enclose together counts", "[repair][lids]") {
  // Five plates that stick out beyond each other, below a gable roof: a room, without a side in common.
  const Mesh room = read_off(
      "OFF\n26 7 0\n-1 -2 -2\n-1 2 -2\n-1 2 2\n-1 -2 2\n1 -2 -2\n1 2 -2\n1 2 2\n1 -2 2\n-2 -1 -2\n-2 -1 2\n2 -1 2\n2 "
      "-1 -2\n"
      "-2 1 -2\n-2 1 2\n2 1 2\n2 1 -2\n-2 -2 -1\n2 -2 -1\n2 2 -1\n-2 2 -1\n-2 -2 1/2\n2 -2 1/2\n2 0 1\n-2 0 1\n2 2 "
      "1/2\n-2 2 1/2\n"
      "4 3 2 1 0\n4 4 5 6 7\n4 11 10 9 8\n4 12 13 14 15\n4 19 18 17 16\n4 20 21 22 23\n4 23 22 24 25\n",
      "room.off");
  const RepairedMesh outside = repair_mesh(room, {.close_percent = 100, .crossings = Crossings::kOutside});
  INFO(outside.problem);
  REQUIRE(outside.problem.empty());
  CHECK(contains(outside.set, {0, 0, 0}));
  CHECK_FALSE(contains(outside.set, {0, 0, Rational(3, 2)}));
  // By winding numbers, nothing but the roof with its lid encloses anything.
  const RepairedMesh wound = repair_mesh(room, {.close_percent = 100, .crossings = Crossings::kUnion});
  CHECK_FALSE(contains(wound.set, {0, 0, 0}));
  CHECK(std::any_of(wound.done.begin(), wound.done.end(),
                    [](const std::string& line) { return line.find("5 flat pieces (5 faces) left out") == 0; }));
}

TEST_CASE("A side that slits separate from the others is a side still", "[repair][lids]") {
  // A cube whose upper square lacks the vertices that stand out a little from the upper sides of the others.
  Mesh box = read_off(
      "OFF\n12 6 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n1 0 2\n2 1 2\n1 2 2\n0 1 2\n"
      "4 3 2 1 0\n5 0 1 5 8 4\n5 1 2 6 9 5\n5 2 3 7 10 6\n5 3 0 4 11 7\n4 4 5 6 7\n",
      "box.off");
  box.vertices[8][1] = Rational(-1, 64);
  box.vertices[9][0] = Rational(129, 64);
  box.vertices[10][1] = Rational(129, 64);
  box.vertices[11][0] = Rational(-1, 64);
  const RepairedMesh closed = repair_mesh(box, {.close_percent = 1, .crossings = Crossings::kUnion});
  INFO(closed.problem);
  REQUIRE(closed.problem.empty());
  CHECK(closed.holes == 4);
  CHECK(closed.flat_holes == 4);
  CHECK(volume(closed.set) > 8);
  CHECK(volume(closed.set) < Rational(81, 10));
}

TEST_CASE("Import closes holes with the lids that a repair would make, and notes it", "[repair][lids]") {
  const Polyhedron cube = make_box({0, 0, 0}, {2, 2, 2});
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  const Mesh whole = to_mesh(cube, polygons).mesh;
  const Mesh open = changed(whole, [](auto& rings) { rings.pop_back(); });
  CHECK_THROWS_WITH(from_mesh(open), Catch::EndsWith("--close (close=10 in Python) closes holes by a guess"));
  CHECK_THROWS_WITH(
      from_mesh(open, {.close_percent = 10}),
      Catch::EndsWith("open there; lids for its hole are more than 10 % of the area, --close=17 accepts them"));
  CHECK_THROWS_WITH(from_mesh(changed(whole, [](auto& rings) { rings.push_back(rings[0]); })),
                    Catch::EndsWith("; nef check lists all problems, nef repair repairs what it can"));
  Messages notes;
  CHECK(equal(from_mesh(open, {.close_percent = 17}, &notes), cube));
  CHECK(notes == Messages{"1 hole closed by lids of 17 % of the area, 1 of them flat (a guess)"});
  // What needs no repair is taken as it is, and a surface stays one.
  notes.clear();
  CHECK(equal(from_mesh(whole, {.close_percent = 10}, &notes), cube));
  CHECK(volume(from_mesh(open, {.as_surface = true, .close_percent = 50}, &notes)) == Rational(0));
  CHECK(notes.empty());
  // Turned faces are turned back; strictness is kept.
  const Mesh mixed = changed(open, [](auto& rings) { std::reverse(rings[0].begin(), rings[0].end()); });
  CHECK_THROWS_WITH(from_mesh(mixed), Catch::Contains("only") || Catch::Contains("nef repair flips faces"));
  CHECK(equal(from_mesh(mixed, {.close_percent = 17}, &notes), cube));
  CHECK(notes.front() == "1 face flipped to match adjacent faces");
  Mesh bent = open;
  bent.vertices[0] = {Rational(-1, 3), Rational(-1, 5), Rational(-1, 7)};
  CHECK_THROWS_WITH(from_mesh(bent, {.strict = true, .close_percent = 40}), Catch::Contains("plan"));
  CHECK(volume(from_mesh(bent, {.close_percent = 40})) > 8);
  // The rule for crossings holds for what is closed.
  const Mesh two = together({cube, make_box({1, 1, 1}, {3, 3, 3})});
  const Mesh torn = changed(two, [](auto& rings) { rings.pop_back(); });
  CHECK(equal(from_mesh(torn, {.crossings = Crossings::kUnion, .close_percent = 10}),
              unite(cube, make_box({1, 1, 1}, {3, 3, 3}))));
  CHECK_THROWS_AS(from_mesh(torn, {.close_percent = 10}), InputError);
}

TEST_CASE("What can not be repaired is told", "[repair]") {
  const Mesh crossing = read_off(
      "OFF\n8 8 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 -1\n5 1 -1\n1 5 -1\n1 1 3\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n",
      "x.off");
  CHECK(repair_mesh(crossing).problem.find("cross") != std::string::npos);
}

}  // namespace nef
