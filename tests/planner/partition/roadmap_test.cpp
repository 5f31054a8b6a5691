// SPDX-License-Identifier: Apache-2.0
//
// The roadmap's completeness, part by part: the leaves of one facet or volume are joined by portals inside that very
// cell, whatever planes have cut it, and portals lead from somewhere to somewhere (apps/planner/partition/).
#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <random>

#include "nef/base/union_find.h"
#include "tests/planner/scene_table.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// Returns the number of facets that are cut into several leaves and thin.
std::size_t check_zones(const FreeSpace& free) {
  const Roadmap& roadmap = free.roadmap();
  UnionFind inside(roadmap.zone_count());
  for (PortalId s = 0; s < roadmap.portals().size(); ++s) {
    CHECK_FALSE(roadmap.zones_of(s).empty());
    std::map<CellId, ZoneId> first;
    for (const ZoneId zone : roadmap.zones_of(s)) {
      inside.unite(zone, first.try_emplace(roadmap.cell_of(zone), zone).first->second);
    }
  }
  std::map<CellId, std::vector<ZoneId>> leaves;
  for (LeafId leaf = 0; leaf < free.tree().leaves().size(); ++leaf) {
    const SpaceTree::Leaf& l = free.tree().leaves()[leaf];
    if (l.dimension < 2 || l.cell == kNoCell || !free.is_free(l.cell)) continue;
    // Seams are leaves of a facet, too, but no zones; leaves beyond everything have no portals.
    if (l.dimension != free.cells().dimension(l.cell) || roadmap.portals_of(leaf).empty()) continue;
    leaves[l.cell].push_back(leaf);
  }
  std::size_t cut = 0;
  for (const auto& [cell, list] : leaves) {
    INFO(free.name(cell));
    for (const ZoneId leaf : list) CHECK(inside.find(leaf) == inside.find(list.front()));
    if (list.size() > 1 && free.local_dimension(cell) == 2) ++cut;
  }
  return cut;
}

TEST_CASE("leaves of one cell are joined inside that cell: the known scenes") {
  for (const Expected& expected : scene_table()) {
    INFO(expected.file);
    check_zones(FreeSpace(free_positions(load(expected.file))));
  }
}

// A block with a slot as thick as the robot, holes across it, and things that stand in the slot; every other seed
// sheared.
Scene slotted_scene(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const int y = number(-2, 3);
  Polyhedron block = subtract(make_box({0, -4, -4}, {8, 6, 6}), make_box({0, y, -4}, {8, y + 1, 6}));
  for (int i = number(1, 5); i > 0; --i) {
    const Rational3 low{number(0, 6), number(-3, 4), number(-3, 4)};
    block = subtract(block, make_box(low, {low[0] + number(1, 3), low[1] + number(1, 2), low[2] + number(1, 2)}));
  }
  Scene scene;
  scene.robot = make_box({0, 0, 0}, {1, 1, 1});
  scene.obstacles.push_back(block);
  for (int i = number(0, 3); i > 0; --i) {
    const int x = number(0, 7);
    const int z = number(-4, 5);
    scene.obstacles.push_back(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
  }
  scene.obstacle_names.assign(scene.obstacles.size(), "");
  if (seed % 2 == 0) return scene;
  AffineMap shear = AffineMap::identity();
  shear.linear[0][1] = Rational(1, 2);
  shear.linear[1][2] = Rational(-2, 3);
  shear.linear[2][0] = Rational(1, 5);
  return mapped(scene, shear);
}

TEST_CASE("leaves of one cell are joined inside that cell: tight plates cut by many planes") {
  std::size_t cut = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(60); ++seed) {
    INFO("seed " << seed);
    cut += check_zones(FreeSpace(free_positions(slotted_scene(seed))));
  }
  CHECK(cut > nef::test::fewer(30));
}

TEST_CASE("the roadmap has a path iff the cells are joined, at every thickness, and the best T and J if asked for") {
  std::size_t paths = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(40); ++seed) {
    INFO("seed " << seed);
    const FreeSpace free(free_positions(slotted_scene(seed)));
    const Roadmap& roadmap = free.roadmap();
    std::vector<Rational3> places;
    for (ZoneId zone = 0; zone < roadmap.zone_count(); ++zone) {
      const CellId cell = roadmap.cell_of(zone);
      if (roadmap.portals_of(zone).empty() || !free.is_free(cell)) continue;
      if (free.local_dimension(cell) < 3 || zone % 16 == 0) places.push_back(roadmap.interior_point(zone));
    }
    std::mt19937 random(seed);
    for (int pair = 0; pair < 10; ++pair) {
      const Rational3& a = places[random() % places.size()];
      const Rational3& b = places[random() % places.size()];
      const std::optional<Thinness> best = free.thinness(free.locate(ExactPoint(a)), free.locate(ExactPoint(b)));
      PathOptions raw;
      raw.raw = true;
      for (raw.min_dimension = 0; raw.min_dimension < 4; ++raw.min_dimension) {
        CHECK(find_path(free, a, b, raw).has_value() == (best && best->piece >= raw.min_dimension));
      }
      if (!best) continue;
      ++paths;
      raw.min_dimension = 0;
      raw.roomy = true;
      const std::optional<ExactPath> roomy = find_path(free, a, b, raw);
      REQUIRE(roomy.has_value());
      CHECK(roomy->thinness.piece == best->piece);
      CHECK(roomy->thinness.junction == best->junction);
    }
  }
  CHECK(paths > nef::test::fewer(100));
}

}  // namespace
}  // namespace nef::planner::test
