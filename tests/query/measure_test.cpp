// SPDX-License-Identifier: Apache-2.0
//
// Volume, area, bounding box, Euler numbers, counts and properties against closed forms, and
// against counting unit cells for unions and differences of boxes on a grid.
#include <rapidcheck.h>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "nef/complex/predicates_of_sets.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"

namespace nef {
namespace {

constexpr int kCells = 5;

// Which unit cells of [0, kCells]^3 a set of boxes fills.
struct Cells {
  std::array<bool, kCells * kCells * kCells> full{};

  static std::size_t index(int x, int y, int z) {
    const int at = (x * kCells + y) * kCells + z;
    return static_cast<std::size_t>(at);
  }
  [[nodiscard]] bool at(int x, int y, int z) const {
    const auto inside = [](int c) { return c >= 0 && c < kCells; };
    return inside(x) && inside(y) && inside(z) && full[index(x, y, z)];
  }
  void fill(const std::array<int, 3>& low, const std::array<int, 3>& high, bool value) {
    for (int x = low[0]; x < high[0]; ++x) {
      for (int y = low[1]; y < high[1]; ++y) {
        for (int z = low[2]; z < high[2]; ++z) full[index(x, y, z)] = value;
      }
    }
  }
  [[nodiscard]] int count() const {
    int result = 0;
    for (const bool cell : full) result += cell ? 1 : 0;
    return result;
  }
  // Unit squares between a full and an empty cell.
  [[nodiscard]] int faces() const {
    int result = 0;
    for (int x = -1; x < kCells; ++x) {
      for (int y = -1; y < kCells; ++y) {
        for (int z = -1; z < kCells; ++z) {
          result +=
              (at(x, y, z) != at(x + 1, y, z)) + (at(x, y, z) != at(x, y + 1, z)) + (at(x, y, z) != at(x, y, z + 1));
        }
      }
    }
    return result;
  }
};

}  // namespace

TEST_CASE("volume, area and properties of solids of cells") {
  CHECK(rc::check("cells", [] {
    Cells cells;
    Polyhedron set;
    const int boxes = *rc::gen::inRange(1, 6);
    for (int i = 0; i < boxes; ++i) {
      std::array<int, 3> low{};
      std::array<int, 3> high{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = *rc::gen::inRange(0, kCells);
        high[k] = *rc::gen::inRange(low[k] + 1, kCells + 1);
      }
      const bool add = i == 0 || *rc::gen::inRange(0, 3) > 0;
      cells.fill(low, high, add);
      const Polyhedron box = make_box({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
      set = regularize(add ? unite(set, box) : subtract(set, box));
    }
    // An affine image, so that no coordinate is an integer and no plane an axis plane.
    AffineMap map = AffineMap::rotate({1, 2, 3}, 25, 1);
    map.translation = {Rational(1, 3), Rational(-2, 7), 5};
    const Polyhedron image = transform(set, map);
    RC_ASSERT(volume(set) == Rational(cells.count()));
    RC_ASSERT(volume(image) == Rational(cells.count()));
    RC_ASSERT(std::fabs(surface_area(image) - cells.faces()) < 1e-9);
    RC_ASSERT(set.is_closed());
    RC_ASSERT(set.is_regular());
    RC_ASSERT(set.is_bounded());
    const Polyhedron inner = interior(set);
    RC_ASSERT(inner.is_open());
    RC_ASSERT(volume(inner) == Rational(cells.count()));
    RC_ASSERT(inner.is_closed() == set.is_empty());
    RC_ASSERT(volume(boundary(set)) == Rational(0));
    const auto box = bounding_box(set);
    RC_ASSERT(box.has_value() == (cells.count() > 0));
    for (std::size_t k = 0; box && k < 3; ++k) {
      // The extreme coordinates are those of extreme full cells.
      int least = kCells;
      int most = 0;
      for (int x = 0; x < kCells; ++x) {
        for (int y = 0; y < kCells; ++y) {
          for (int z = 0; z < kCells; ++z) {
            const std::array<int, 3> cell{x, y, z};
            if (!cells.at(x, y, z)) continue;
            least = std::min(least, cell[k]);
            most = std::max(most, cell[k] + 1);
          }
        }
      }
      RC_ASSERT((*box)[0][k] == least);
      RC_ASSERT((*box)[1][k] == most);
    }
  }));
}

TEST_CASE("closed forms") {
  const std::vector<Rational3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Polyhedron tetrahedron = convex_hull(corners);
  CHECK(volume(tetrahedron) == Rational(1, 6));
  CHECK(surface_area(tetrahedron) == Approx(1.5 + std::sqrt(3.0) / 2).epsilon(1e-15));
  CHECK(euler_numbers(tetrahedron) == std::vector<long>{2, 2});
  CHECK(counts(tetrahedron).edges == 6);
  CHECK(volume(Polyhedron()) == Rational(0));
  CHECK_FALSE(volume(Polyhedron::everything()));
  CHECK_FALSE(volume(complement(tetrahedron)));
  CHECK(volume(make_segment({0, 0, 0}, {1, 2, 3})) == Rational(0));
  CHECK(surface_area(make_point({1, 2, 3})) == 0);
  CHECK_FALSE(bounding_box(Polyhedron::everything()));
  const Rational3 spot{Rational(1, 3), -2, 7};
  REQUIRE(bounding_box(make_point(spot)));
  CHECK((*bounding_box(make_point(spot)))[0] == spot);
  CHECK((*bounding_box(make_point(spot)))[1] == spot);
}

TEST_CASE("Euler numbers of shells") {
  const Polyhedron cube = make_box({0, 0, 0}, {9, 9, 9});
  // A frame: a torus seen from both sides.
  const Polyhedron frame = subtract(cube, make_box({3, 3, -1}, {6, 6, 10}));
  CHECK(euler_numbers(frame) == std::vector<long>{0, 0});
  CHECK(volume(frame) == Rational(729 - 81));
  // A cavity: two shells around the solid, one inside, one outside.
  const Polyhedron hollow = subtract(cube, make_box({3, 3, 3}, {6, 6, 6}));
  CHECK(euler_numbers(hollow) == std::vector<long>{2, 2, 2, 2});
  CHECK(counts(hollow).volumes == 3);
  // An edge and a point alone: one shell each in the outer volume.
  CHECK(euler_numbers(make_point({1, 1, 1})) == std::vector<long>{1});
  // What is at infinity does not count: a plane has one facet, an octant's border a vertex, three edges and three
  // facets.
  const Polyhedron half_space = make_halfspace(0, 0, 1, 0, true);
  CHECK(euler_numbers(half_space) == std::vector<long>{1, 1});
  CHECK(genera(half_space.complex()) == std::vector<std::optional<long>>(2));
  const Polyhedron octant =
      intersect(intersect(half_space, make_halfspace(1, 0, 0, 0, true)), make_halfspace(0, 1, 0, 0, true));
  CHECK(euler_numbers(octant) == std::vector<long>{1, 1});
  const Polyhedron around = complement(make_box({0, 0, 0}, {1, 1, 1}));
  CHECK(euler_numbers(around) == std::vector<long>{2, 2});
  CHECK(genera(around.complex()) == std::vector<std::optional<long>>{0, 0});
  CHECK(counts(around).shells == 2);
  CHECK(euler_numbers(make_segment({0, 0, 0}, {1, 1, 1})) == std::vector<long>{1});
  // A plate with a square hole: a ring.
  const std::vector<std::vector<Rational3>> rings{{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}},
                                                  {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}};
  CHECK(euler_numbers(make_polygon(rings)) == std::vector<long>{0});
  // A facet with an isolated vertex in it: a disk still.
  const Polyhedron pricked = subtract(make_box({0, 0, 0}, {2, 2, 0}), make_point({1, 1, 0}));
  CHECK(counts(pricked).vertices == 5);
  CHECK(euler_numbers(pricked) == std::vector<long>{1});
  // Two cubes that touch at a vertex: one shell outside, two inside.
  const Polyhedron touching = unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 1}, {2, 2, 2}));
  std::vector<long> numbers = euler_numbers(touching);
  std::sort(numbers.begin(), numbers.end());
  CHECK(numbers == std::vector<long>{2, 2, 3});
}

TEST_CASE("what reaches infinity has no finite measure") {
  const Polyhedron half = make_halfspace(1, 2, 3, 4);
  CHECK_FALSE(volume(half));
  CHECK(surface_area(half) == std::numeric_limits<double>::infinity());
  CHECK_FALSE(half.is_bounded());
  CHECK(half.is_closed());
  CHECK(half.is_regular());
  CHECK_FALSE(half.is_open());
  CHECK(make_halfspace(1, 2, 3, 4, false).is_open());
  const Counts count = counts(half);
  CHECK(count.vertices == 0);
  CHECK(count.edges == 0);
  CHECK(count.facets == 1);
  CHECK(count.volumes == 2);
  CHECK(count.shells == 2);

  // A plane: two volumes, none of them selected.
  const Polyhedron plane = intersect(half, make_halfspace(-1, -2, -3, -4));
  CHECK(volume(plane) == Rational(0));
  CHECK_FALSE(is_bounded_set(plane.complex()));
  CHECK(plane.is_closed());
  CHECK_FALSE(plane.is_regular());
  // A line.
  const Polyhedron line = intersect(plane, intersect(make_halfspace(1, 0, 0, 0), make_halfspace(-1, 0, 0, 0)));
  CHECK(counts(line).edges == 1);
  CHECK(counts(line).vertices == 0);
  CHECK(volume(line) == Rational(0));
  CHECK_FALSE(is_bounded_set(line.complex()));
  // A slab minus its middle: infinite; what is cut from a wedge by a plane: finite.
  const std::vector<Polyhedron> sides{make_halfspace(-1, 0, 0, 0), make_halfspace(0, -1, 0, 0),
                                      make_halfspace(0, 0, -1, 0), make_halfspace(1, 1, 1, -1)};
  CHECK_FALSE(volume(intersect_all(std::span(sides).first(3))));
  CHECK(volume(intersect_all(sides)) == Rational(1, 6));
  CHECK(is_bounded_set(intersect_all(sides).complex()));
  CHECK(intersect_all(sides).is_bounded());
}

TEST_CASE("openness of mixed sets") {
  const Polyhedron cube = make_box({0, 0, 0}, {2, 2, 2});
  const Polyhedron facet = make_box({0, 0, 0}, {2, 2, 0});
  const Polyhedron partly = subtract(cube, facet);
  CHECK_FALSE(partly.is_open());
  CHECK_FALSE(partly.is_closed());
  CHECK(volume(partly) == Rational(8));
  const Polyhedron antenna = unite(cube, make_segment({2, 1, 1}, {5, 1, 1}));
  CHECK(antenna.is_closed());
  CHECK_FALSE(antenna.is_regular());
  CHECK((*bounding_box(antenna))[1][0] == 5);
  const Polyhedron punctured = subtract(cube, make_point({1, 1, 1}));
  CHECK_FALSE(punctured.is_closed());
  CHECK_FALSE(punctured.is_regular());
  CHECK(volume(punctured) == Rational(8));
}

TEST_CASE("genus of shells: tunnels count, pinched and unbounded surfaces have none") {
  const auto genus = [](const Polyhedron& set) { return genera(set.complex()); };
  using Genera = std::vector<std::optional<long>>;
  Polyhedron block = make_box({0, 0, 0}, {20, 3, 3});
  CHECK(genus(block) == Genera{0, 0});
  for (int tunnels = 1; tunnels <= 4; ++tunnels) {
    block = subtract(block, make_box({5 * tunnels - 4, 1, -1}, {5 * tunnels - 3, 2, 4}));
    CHECK(genus(block) == Genera{tunnels, tunnels});
  }
  // A cavity is a sphere of its own, seen from the solid and from within.
  const Polyhedron hollow = subtract(make_box({0, 0, 0}, {3, 3, 3}), make_box({1, 1, 1}, {2, 2, 2}));
  CHECK(genus(hollow) == Genera{0, 0, 0, 0});
  // Two cubes at an edge, at a corner; a facet; a half-space.
  const Polyhedron cube = make_box({0, 0, 0}, {1, 1, 1});
  for (const auto& g : genus(unite(cube, make_box({1, 1, 0}, {2, 2, 1})))) CHECK_FALSE(g);
  const Genera corner = genus(unite(cube, make_box({1, 1, 1}, {2, 2, 2})));
  CHECK(std::all_of(corner.begin(), corner.end(), [](const auto& g) { return !g; }));
  for (const auto& g : genus(make_box({0, 0, 0}, {1, 1, 0}))) CHECK_FALSE(g);
  for (const auto& g : genus(make_halfspace(0, 0, 1, 0))) CHECK_FALSE(g);
}

}  // namespace nef
