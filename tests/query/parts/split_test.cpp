// SPDX-License-Identifier: Apache-2.0
//
// Components against a flood fill over the cells (corners, edges, squares, cubes) of a grid.
#include "nef/parts/split.h"

#include "nef/base/union_find.h"
#include "tests/laws/laws.h"

namespace nef {
namespace {

using test::set;

// Cells of all dimensions of the grid of integers 0 .. kGrid and what lies around it: along each axis, 2i + 1 is the
// coordinate i and 2i the gap before it. Sets whose planes are grid planes are unions of such cells.
constexpr int kGrid = 4;
constexpr int kSteps = 2 * kGrid + 3;

Rational3 centre(int i, int j, int k) { return {Rational(i - 1) / 2, Rational(j - 1) / 2, Rational(k - 1) / 2}; }

std::uint32_t cell(int i, int j, int k) { return static_cast<std::uint32_t>((i * kSteps + j) * kSteps + k); }

// Visits the cells in the closure of a cell: along each axis, a gap and its ends.
template <typename Visit>
void for_each_in_closure(int i, int j, int k, const Visit& visit) {
  const auto ends = [](int c) { return c % 2 == 0 ? std::vector<int>{c, c - 1, c + 1} : std::vector<int>{c}; };
  for (const int x : ends(i)) {
    for (const int y : ends(j)) {
      for (const int z : ends(k)) {
        if (x >= 0 && y >= 0 && z >= 0 && x < kSteps && y < kSteps && z < kSteps) visit(x, y, z);
      }
    }
  }
}

// Steps with planes of the grid only: boxes, flat and open ones among them, points, and half-spaces.
test::Primitive grid_primitive(bool bounded) {
  test::Primitive result;
  const int kind = *rc::gen::inRange(0, bounded ? 4 : 6);
  for (std::size_t i = 0; i < 3; ++i) {
    int low = *rc::gen::inRange(0, kGrid);
    int high = *rc::gen::inRange(0, kGrid);
    if (low > high) std::swap(low, high);
    result.n[i] = low;
    result.n[i + 3] = kind == 0 ? high + 1 : high;
  }
  result.shape = kind <= 1 ? test::Shape::kBox : kind == 2 ? test::Shape::kOpenBox : test::Shape::kPoint;
  if (kind == 2) {
    for (std::size_t i = 3; i < 6; ++i) ++result.n[i];
  }
  if (kind >= 4) {
    result.shape = kind == 4 ? test::Shape::kHalfspace : test::Shape::kOpenHalfspace;
    const auto axis = *rc::gen::inRange<std::size_t>(0, 3);
    const int at = result.n[3];
    result.n = {};
    result.n[axis] = *rc::gen::element(1, -1);
    result.n[3] = -result.n[axis] * at;
  }
  return result;
}

test::Recipe grid_recipe(bool bounded) {
  test::Recipe recipe;
  const int steps = *rc::gen::inRange(1, 9);
  for (int i = 0; i < steps; ++i) {
    recipe.steps.push_back(
        {i == 0 ? '+' : *rc::gen::element('+', '+', '+', '-', '-', '^'), false, grid_primitive(bounded)});
  }
  return recipe;
}

// The components of the cells of the set; `in` tells which cells these are.
UnionFind flood(const test::Recipe& recipe, std::vector<bool>& in) {
  in.assign(kSteps * kSteps * kSteps, false);
  UnionFind sets(in.size());
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        for (int k = 0; k < kSteps; ++k) {
          if (pass == 0) {
            in[cell(i, j, k)] = recipe.contains(centre(i, j, k));
          } else if (in[cell(i, j, k)]) {
            for_each_in_closure(i, j, k, [&](int x, int y, int z) {
              if (in[cell(x, y, z)]) sets.unite(cell(i, j, k), cell(x, y, z));
            });
          }
        }
      }
    }
  }
  return sets;
}

}  // namespace

TEST_CASE("components are those of a flood fill") {
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(bounded ? "bounded" : "unbounded", [bounded] {
      const test::Recipe recipe = grid_recipe(bounded);
      RC_TAG(recipe.steps.size());
      const Polyhedron whole = recipe.make();
      const std::vector<Polyhedron> parts = split(whole);
      for (const Polyhedron& part : parts) RC_ASSERT(validate(part.complex()).empty());
      std::vector<bool> in;
      UnionFind sets = flood(recipe, in);
      // Each component's cells are in one part alone, and parts of different components differ.
      std::vector<std::size_t> part_of(in.size(), parts.size());
      std::size_t components = 0;
      for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
          for (int k = 0; k < kSteps; ++k) {
            if (sets.find(cell(i, j, k)) == cell(i, j, k) && in[cell(i, j, k)]) ++components;
          }
        }
      }
      RC_ASSERT(parts.size() == components);
      for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
          for (int k = 0; k < kSteps; ++k) {
            std::size_t holders = 0;
            std::size_t holder = 0;
            for (std::size_t p = 0; p < parts.size(); ++p) {
              if (!contains(parts[p], centre(i, j, k))) continue;
              ++holders;
              holder = p;
            }
            RC_ASSERT(holders == (in[cell(i, j, k)] ? 1U : 0U));
            if (holders == 0) continue;
            std::size_t& known = part_of[sets.find(cell(i, j, k))];
            if (known == parts.size()) known = holder;
            RC_ASSERT(known == holder);
          }
        }
      }
    }));
  }
}

TEST_CASE("components make up the set and keep apart") {
  test::for_all("split", 4, [](const test::Recipe& recipe) {
    const Polyhedron whole = recipe.make();
    const std::vector<Polyhedron> parts = split(whole);
    test::same(unite_all(parts), whole, "the union of the components");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      RC_ASSERT(validate(parts[i].complex()).empty());
      RC_ASSERT(split(parts[i]).size() == 1U);
      for (std::size_t j = 0; j < parts.size(); ++j) {
        if (i != j) RC_ASSERT(intersect(parts[i], closure(parts[j])).is_empty());
      }
    }
  });
}

TEST_CASE("volumes with their boundaries") {
  test::for_all("split_volumes", 4, [](const test::Recipe& recipe) {
    const Polyhedron whole = recipe.make();
    const std::vector<Polyhedron> parts = split_volumes(whole);
    RC_ASSERT(parts.size() == split(interior(whole)).size());
    Polyhedron all;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      test::same(parts[i], intersect(whole, closure(interior(parts[i]))), "a volume and its boundary");
      for (std::size_t j = 0; j < i; ++j) RC_ASSERT(intersect(interior(parts[i]), interior(parts[j])).is_empty());
      all = unite(all, parts[i]);
    }
    test::same(all, intersect(whole, closure(interior(whole))), "the union of the volumes");
  });
}

TEST_CASE("what is one piece and what is two") {
  CHECK(split(Polyhedron()).empty());
  CHECK(split(Polyhedron::everything()).size() == 1);
  CHECK(split_volumes(Polyhedron()).empty());
  CHECK(split_volumes(Polyhedron::everything()).size() == 1);
  const Polyhedron at_an_edge = set("box(0,0,0,1,1,1) + box(1,1,0,2,2,1)");
  CHECK(split(at_an_edge).size() == 1);
  CHECK(split_volumes(at_an_edge).size() == 2);
  CHECK(split(set("box(0,0,0,1,1,1) + box(1,1,0,2,2,1) - segment(1,1,0,1,1,1)")).size() == 2);
  // An open point in the shared edge leaves two ways; a wall without points parts a cube in two.
  CHECK(split(set("box(0,0,0,1,1,1) + box(1,1,0,2,2,1) - point(1,1,1/2)")).size() == 1);
  CHECK(split(set("box(0,0,0,2,2,2) - box(1,0,0,1,2,2)")).size() == 2);
  CHECK(split(set("box(0,0,0,2,2,2) - (box(1,0,0,1,2,2) - point(1,1,1))")).size() == 1);
  // A shell with a ball in it, the outside of a cube, and both sides of a plane.
  const Polyhedron nested = set("box(0,0,0,9,9,9) - interior(box(1,1,1,8,8,8)) + box(3,3,3,5,5,5)");
  REQUIRE(split(nested).size() == 2);
  CHECK(equal(split(nested)[0], set("box(0,0,0,9,9,9) - interior(box(1,1,1,8,8,8))")));
  CHECK(equal(split(nested)[1], set("box(3,3,3,5,5,5)")));
  const std::vector<Polyhedron> around = split(set("!box(0,0,0,3,3,3) + box(1,1,1,2,2,2)"));
  REQUIRE(around.size() == 2);
  CHECK(equal(around[0], set("!box(0,0,0,3,3,3)")));
  CHECK(equal(around[1], set("box(1,1,1,2,2,2)")));
  CHECK(split(set("!boundary(halfspace(1,2,3,4))")).size() == 2);
  CHECK(
      split(set("boundary(halfspace(1,0,0,0)) - boundary(halfspace(0,1,0,0)) - boundary(halfspace(0,0,1,0))")).size() ==
      4);
  CHECK(split(set("point(0,0,0) + point(1,0,0) + segment(2,0,0,3,0,0)")).size() == 3);
}

}  // namespace nef
