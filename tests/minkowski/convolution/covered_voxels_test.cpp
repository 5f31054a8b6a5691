// SPDX-License-Identifier: Apache-2.0
//
// Sums of sets of cells against all pairs of cells; cubes that are said to be covered against the sum of two solids by
// convex cells.
#include "apps/minkowski/convolution/facets/covered_voxels.h"

#include <rapidcheck.h>

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "apps/minkowski/minkowski.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/machine_parts.h"

namespace {

using nef::Double3;
using nef::Polyhedron;
using nef::Rational3;
using nef::minkowski::BitGrid;
using nef::minkowski::CoveredVoxels;
using nef::minkowski::SolidFeatures;

BitGrid random_grid(int width, int height, int depth, int filled) {
  BitGrid grid(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
               static_cast<std::uint32_t>(depth));
  for (int k = 0; k < filled; ++k) {
    const auto y = static_cast<std::uint32_t>(*rc::gen::inRange(0, height));
    const int first = *rc::gen::inRange(0, width);
    const int last = *rc::gen::inRange(first, width);
    const int low = *rc::gen::inRange(0, depth);
    const int high = *rc::gen::inRange(low, depth);
    for (int z = low; z <= high; ++z) {
      for (int x = first; x <= last; ++x) grid.set(static_cast<std::uint32_t>(x), y, static_cast<std::uint32_t>(z));
    }
  }
  return grid;
}

template <typename Visit>
void for_each_cell(const BitGrid& grid, Visit&& visit) {
  for (std::uint32_t z = 0; z < grid.size()[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size()[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size()[0]; ++x) visit(std::array<std::uint32_t, 3>{x, y, z});
    }
  }
}

TEST_CASE("sums of grids are those of all pairs of cells") {
  nef::test::check("grids", 100, [] {
    const bool is_planar = *rc::gen::inRange(0, 2) == 0;
    const auto make = [&](int widest) {
      return random_grid(*rc::gen::inRange(1, widest), *rc::gen::inRange(1, 6), is_planar ? 1 : *rc::gen::inRange(2, 6),
                         5);
    };
    const BitGrid p = make(150);
    const BitGrid q = make(70);
    std::vector<std::array<std::uint32_t, 3>> of_q;
    for_each_cell(q, [&](const auto& j) {
      if (q.has(j[0], j[1], j[2])) of_q.push_back(j);
    });
    BitGrid truth(p.size()[0] + q.size()[0], p.size()[1] + q.size()[1], is_planar ? 1 : p.size()[2] + q.size()[2]);
    for_each_cell(p, [&](const auto& i) {
      if (!p.has(i[0], i[1], i[2])) return;
      for (const auto& j : of_q) {
        for (std::uint32_t k = 0; k < (is_planar ? 4U : 8U); ++k)
          truth.set(i[0] + j[0] + (k & 1U), i[1] + j[1] + (k >> 1U & 1U), i[2] + j[2] + (k >> 2U));
      }
    });
    const std::optional<BitGrid> sum = BitGrid::sum(p, q);
    RC_ASSERT(sum.has_value());
    for_each_cell(truth, [&](const auto& c) { RC_ASSERT(sum->has(c[0], c[1], c[2]) == truth.has(c[0], c[1], c[2])); });
  });
}

// Points at random around a sum that are covered, and how many were asked.
void check_covered(const Polyhedron& a, const Polyhedron& b, std::size_t least) {
  const SolidFeatures of_a(a, {});
  const SolidFeatures of_b(b, {});
  const CoveredVoxels covered(of_a, of_b, 48, {});
  nef::minkowski::MinkowskiOptions options;
  options.strategy = nef::minkowski::UnionStrategy::kQueue;
  const Polyhedron open = nef::interior(nef::minkowski::minkowski_sum(a, b, options));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-12, 12);
  std::uniform_real_distribution<double> step(-0.5, 0.5);
  std::size_t found = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<Double3, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[0][i] = place(random);
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[1][i] = triangle[0][i] + step(random);
      triangle[2][i] = triangle[0][i] + step(random);
    }
    if (!covered.cover(triangle)) continue;
    ++found;
    if (found > 300) continue;        // enough to locate
    for (int at = 0; at < 4; ++at) {  // corners, and a point inside
      Rational3 x;
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = at < 3 ? nef::exact_rational(triangle[static_cast<std::size_t>(at)][i])
                      : nef::Rational((nef::exact_rational(triangle[0][i]) + nef::exact_rational(triangle[1][i]) +
                                       nef::exact_rational(triangle[2][i])) /
                                      3);
      }
      REQUIRE(nef::contains(open, x));
    }
  }
  INFO(found);
  CHECK(found >= least);
}

TEST_CASE("covered cubes lie in the inside of the sum") {
  const Polyhedron gear = nef::from_mesh(nef::test::extruded_part(nef::test::gear_outline(5, 4, 1), 5));
  constexpr std::array<nef::test::ProfilePoint, 4> kRing = {{{3, 0}, {5, 0}, {4.5, 3}, {3, 3}}};
  const Polyhedron ring = nef::from_mesh(nef::test::turned_part(kRing, 9, 0.1));
  const Polyhedron lying = nef::from_mesh(nef::test::turned_part(kRing, 7, 0.3, true));
  check_covered(gear, ring, 300);
  check_covered(ring, lying, 100);
  check_covered(gear, nef::test::set("box(-4,-4,-4,4,4,4) - interior(box(-3,-3,-3,3,3,3))"), 300);
}

TEST_CASE("nothing is covered where doubles have too few digits, or a solid is thin") {
  const Polyhedron cube = nef::test::set("box(0,0,0,1,1,1)");
  const Polyhedron far = nef::test::moved(cube, {nef::Rational(nef::Integer(1) << 50), 0, 0});
  const Polyhedron thin = nef::test::set("box(0,0,0,1/1000,1,1)");
  const Double3 middle = {0.9, 0.9, 0.9};
  const Double3 far_middle = {0x1p50 + 1, 0.9, 0.9};
  CHECK(CoveredVoxels(SolidFeatures(cube, {}), SolidFeatures(cube, {}), 16, {}).cover({&middle, 1}));
  CHECK_FALSE(CoveredVoxels(SolidFeatures(cube, {}), SolidFeatures(cube, {}), 16, {}).cover({&middle, 1}, 0.1));
  CHECK_FALSE(CoveredVoxels(SolidFeatures(far, {}), SolidFeatures(cube, {}), 16, {}).cover({&far_middle, 1}));
  CHECK_FALSE(CoveredVoxels(SolidFeatures(thin, {}), SolidFeatures(cube, {}), 16, {}).cover({&middle, 1}));
  CHECK_FALSE(CoveredVoxels().cover({&middle, 1}));
}

}  // namespace
