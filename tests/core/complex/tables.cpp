// SPDX-License-Identifier: Apache-2.0
//
// Tables that leave out what says nothing give back what was put in; and what a finished set holds.
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "nef/complex/tables/facet_table.h"
#include "nef/complex/tables/vertex_table.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

std::uint32_t drawn(std::mt19937& random, std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); }

bool alike(const Facet& a, const Facet& b) {
  return a.plane == b.plane && a.mark == b.mark && a.first_cycle == b.first_cycle && a.cycle_count == b.cycle_count &&
         (a.isolated_count == 0 || a.first_isolated == b.first_isolated) && a.isolated_count == b.isolated_count &&
         a.volume_above == b.volume_above && a.volume_below == b.volume_below;
}

bool alike(const VertexRecord& a, const VertexRecord& b) {
  return a.svertices == b.svertices && a.shalfedges == b.shalfedges && a.sloops == b.sloops && a.sfaces == b.sfaces &&
         a.other_planes == b.other_planes && a.pattern == b.pattern;
}

// One facet of `rare` has holes, or vertices inside; none if it is 0.
std::vector<Facet> random_facets(std::mt19937& random, std::size_t count, std::uint32_t rare, std::uint32_t volumes) {
  std::vector<Facet> facets(count);
  CycleId cycle{0};
  std::uint32_t isolated = 0;
  for (Facet& facet : facets) {
    facet.plane = PlaneId{2 * drawn(random, 1000)};
    facet.mark = static_cast<LabelId>(drawn(random, 2));
    facet.first_cycle = cycle;
    facet.cycle_count = rare != 0 && drawn(random, rare) == 0 ? 1 + drawn(random, 4) : 1;
    facet.first_isolated = isolated;
    facet.isolated_count = rare != 0 && drawn(random, rare) == 0 ? drawn(random, 3) : 0;
    facet.volume_above = VolumeId{drawn(random, volumes)};
    facet.volume_below = VolumeId{drawn(random, volumes)};
    cycle += facet.cycle_count;
    isolated += facet.isolated_count;
  }
  return facets;
}

FacetTable table_of(const std::vector<Facet>& facets) {
  FacetTable table;
  for (const Facet& facet : facets) table.push_back(facet);
  return table;
}

bool holds(const FacetTable& table, const std::vector<Facet>& facets) {
  if (table.size() != facets.size()) return false;
  for (const FacetId f : table.ids()) {
    if (!alike(table[f], facets[f.index()])) return false;
  }
  return std::equal(table.begin(), table.end(), facets.begin(),
                    [](const Facet& a, const Facet& b) { return alike(a, b); });
}

}  // namespace

TEST_CASE("a table of facets gives back what was put in, with holes and vertices inside or without") {
  std::mt19937 random(5);
  for (const std::uint32_t rare : {0U, 1U, 7U, 60U}) {
    for (const std::uint32_t volumes : {1U, 2U, 40U}) {
      CAPTURE(rare, volumes);
      std::vector<Facet> facets = random_facets(random, 100, rare, volumes);
      FacetTable table = table_of(facets);
      CHECK(holds(table, facets));

      std::vector<FacetSides> sides;
      for (Facet& facet : facets) {
        facet.mark = static_cast<LabelId>(drawn(random, 3));
        facet.volume_below = VolumeId{drawn(random, volumes)};
        sides.push_back({facet.mark, facet.volume_above, facet.volume_below});
      }
      table.assign_sides(sides);
      CHECK(holds(table, facets));

      table.assign_marks([&](FacetId f) { return static_cast<LabelId>(table[f].mark + 1); });
      FacetTable::for_each_mark(table, [](LabelId& mark) { mark = static_cast<LabelId>(mark * 2); });
      for (Facet& facet : facets) facet.mark = static_cast<LabelId>(2 * facet.mark + 2);
      CHECK(holds(table, facets));

      const FacetId f{drawn(random, 99)};
      Facet& changed = facets[f.index()];
      changed.plane = changed.plane.opposite();
      changed.mark = 9;
      table.set(f, changed);
      CHECK(holds(table, facets));
    }
  }
}

TEST_CASE("tables of facets are put one behind the other") {
  std::mt19937 random(6);
  for (const std::uint32_t rare : {0U, 5U}) {
    for (const std::uint32_t rare_behind : {0U, 5U}) {
      CAPTURE(rare, rare_behind);
      std::vector<Facet> facets = random_facets(random, 30, rare, 3);
      const std::vector<Facet> more = random_facets(random, 40, rare_behind, 3);
      FacetTable table = table_of(facets);
      table.append(table_of(more));
      const CycleId cycles = facets.back().cycles().end_id();
      const std::uint32_t isolated = facets.back().first_isolated + facets.back().isolated_count;
      for (Facet facet : more) {
        facet.first_cycle += cycles.index();
        facet.first_isolated += isolated;
        facets.push_back(facet);
      }
      CHECK(holds(table, facets));
      table.clear();
      CHECK(table.empty());
    }
  }
}

TEST_CASE("a table of vertices gives back what was put in, whichever columns it needs") {
  std::mt19937 random(7);
  for (std::uint32_t needs = 0; needs < 8; ++needs) {
    CAPTURE(needs);
    const auto rarely = [&](std::uint32_t bit) { return (needs & bit) != 0 && drawn(random, 9) == 0; };
    VertexTable table;
    std::vector<VertexRecord> records(1);
    for (std::uint32_t v = 0; v < 80; ++v) {
      VertexRecord end = records.back();
      const std::uint32_t svertices = 3 + drawn(random, 5);
      end.svertices += svertices;
      end.shalfedges += 2 * svertices + (rarely(1) ? 2 : 0);
      end.sloops += rarely(2) ? 2 : 0;
      end.sfaces += 2;
      end.other_planes += rarely(4) ? 1 : 0;
      records.back().pattern = PatternId{drawn(random, 9)};
      table.add(records.back().pattern, end);
      end.pattern = PatternId();
      records.push_back(end);
    }
    REQUIRE(table.size() == records.size());
    CHECK(std::equal(table.begin(), table.end(), records.begin(),
                     [](const VertexRecord& a, const VertexRecord& b) { return alike(a, b); }));
    if ((needs & 1U) == 0) CHECK(table.has_two_shalfedges_per_svertex());

    VertexRecord& changed = records[drawn(random, 80)];
    const VertexId v{&changed - records.data()};
    changed.sloops += 2;
    changed.other_planes += 3;
    table.set(v, changed);
    CHECK(alike(table[v], changed));
    CHECK(alike(table.back(), records.back()));
  }
}

TEST_CASE("a set made from a mesh of triangles holds at most 400 bytes a vertex") {
  const Polyhedron sphere = from_mesh(to_mesh(make_sphere(Rational(7), 48)).mesh);
  const Complex& c = sphere.complex();
  REQUIRE(c.vertex_count() > 1000);
  CHECK(c.bytes() <= 400 * c.vertex_count());
}

}  // namespace nef::test
