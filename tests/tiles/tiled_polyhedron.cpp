// SPDX-License-Identifier: Apache-2.0
//
// What is done in tiles (nef/tiles/) is what is done without them, whatever the cuts.
#include <catch2/catch.hpp>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/tiles/cuts/cutter.h"
#include "tests/tiles/cuts.h"

namespace nef::test {
namespace {

// Runs a property for bounded and unbounded sets.
template <typename Property>
void for_all_cut_pairs(const std::string& name, std::size_t steps, Property property) {
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(name + (bounded ? " (bounded)" : " (unbounded)"), [&] {
      const Recipe a = *recipes(bounded, steps).as("A");
      const Recipe b = *recipes(bounded, steps).as("B");
      const Cuts of_a = *some_cuts(5).as("cuts of A");
      const Cuts of_b = *some_cuts(5).as("cuts of B");
      property(a.make(), b.make(), of_a, of_b);
    }));
  }
}

}  // namespace

TEST_CASE("cut and glued is the same set") {
  for_all_cut_pairs("cut and glued", 4, [](const Polyhedron& a, const Polyhedron&, const Cuts& cuts, const Cuts&) {
    const TiledPolyhedron in_tiles = tiled(a, cuts);
    leaves_are_valid(in_tiles.tree(), "cut");
    glued_is(in_tiles, a, "glued");
    glued_is(complement(in_tiles), complement(a), "complement");
    glued_is(complement(complement(in_tiles)), a, "complement of the complement");
  });
}

TEST_CASE("operations in tiles are those on whole sets") {
  for_all_cut_pairs("operations", 3, [](const Polyhedron& a, const Polyhedron& b, const Cuts& of_a, const Cuts& of_b) {
    const TiledPolyhedron x = tiled(a, of_a);
    const TiledPolyhedron y = tiled(b, of_b);
    glued_is(unite(x, y), unite(a, b), "A + B");
    glued_is(intersect(x, y), intersect(a, b), "A * B");
    glued_is(subtract(x, y), subtract(a, b), "A - B");
    glued_is(symmetric_difference(x, y), symmetric_difference(a, b), "A ^ B");
    glued_is(subtract(complement(x), y), subtract(complement(a), b), "!A - B");
    glued_is(unite(x, complement(y)), unite(a, complement(b)), "A + !B");
    leaves_are_valid(symmetric_difference(complement(x), y).tree(), "!A ^ B");
  });
}

TEST_CASE("a plain operand need not be cut") {
  for_all_cut_pairs("plain operand", 3, [](const Polyhedron& a, const Polyhedron& b, const Cuts& of_a, const Cuts&) {
    const TiledPolyhedron x = tiled(a, of_a);
    glued_is(unite(x, b), unite(a, b), "A + B");
    glued_is(intersect(x, b), intersect(a, b), "A * B");
    glued_is(subtract(x, b), subtract(a, b), "A - B");
    glued_is(symmetric_difference(complement(x), b), symmetric_difference(complement(a), b), "!A ^ B");
  });
}

TEST_CASE("tiles small enough to split and join under way", "[threads]") {
  for_all_cut_pairs("small tiles", 4, [](const Polyhedron& a, const Polyhedron& b, const Cuts&, const Cuts&) {
    const Tiling tiling{*rc::gen::inRange<std::size_t>(8, 40)};
    const Monitor monitor = Monitor().on_threads(*rc::gen::element(1U, 2U));
    const TiledPolyhedron x(a, tiling, monitor);
    leaves_are_valid(x.tree(), "A");
    glued_is(x, a, "A");
    glued_is(unite(x, b, monitor), unite(a, b), "A + B");
    glued_is(subtract(subtract(x, b, monitor), TiledPolyhedron(b, tiling), monitor), subtract(a, b), "A - B - B");
    glued_is(intersect(unite(x, b), b, monitor), b, "(A + B) * B");
    if (!equal(symmetric_difference(symmetric_difference(x, b, monitor), b, monitor), x)) RC_FAIL("A ^ B ^ B");
  });
}

TEST_CASE("tiles of a large set are larger, if nobody says how large") {
  CHECK(tiling_for(0).limit == 128);
  CHECK(tiling_for(256 * 128).limit == 128);
  CHECK(tiling_for(655'362).limit == 2560);
  const Polyhedron box = make_box({0, 0, 0}, {1, 1, 1});
  CHECK(TiledPolyhedron(box).tiling().limit == 128);
  CHECK(TiledPolyhedron(box, {.limit = 64}).tiling().limit == 64);
}

TEST_CASE("a tile that nobody has cut is cut where a step touches it") {
  std::vector<Polyhedron> boxes;
  for (int i = 0; i < 10; ++i) {
    const Rational x = 20 + 3 * (i % 5);
    boxes.push_back(
        make_box({x, 3 * (i / 5 % 5) - 5, 3 * (i / 25) - 1}, {x + 2, 3 * (i / 5 % 5) - 3, 3 * (i / 25) + 1}));
  }
  const Polyhedron far = unite_all(boxes);
  std::size_t cut = 0;
  for_all_cut_pairs("uncut", 2, [&](const Polyhedron& a, const Polyhedron& b, const Cuts&, const Cuts&) {
    const Polyhedron whole = unite(a, far);
    const Tiling tiling{*rc::gen::inRange<std::size_t>(16, 60)};
    const TiledPolyhedron x(tile_leaf(without_labels(whole, {}), nullptr, true), tiling);
    glued_is(unite(x, b), unite(whole, b), "A + B");
    glued_is(intersect(x, b), intersect(whole, b), "A * B");
    glued_is(subtract(complement(x), b), subtract(complement(whole), b), "!A - B");
    const TiledPolyhedron once = symmetric_difference(x, b);
    leaves_are_valid(once.tree(), "A ^ B");
    const Polyhedron moved = transform(b, AffineMap::translate({22, -2, 0}));
    glued_is(subtract(once, moved), subtract(symmetric_difference(whole, b), moved), "A ^ B - C");
    glued_is({fully_cut(once.tree(), tiling, {}), tiling}, symmetric_difference(whole, b), "A ^ B, cut");
    if (once.tile_count() > 1) ++cut;
  });
  CHECK(cut > 0);  // two of three, whatever the number of cases
}

TEST_CASE("queries in tiles are those of the whole set") {
  for_all_cut_pairs("queries", 4, [](const Polyhedron& a, const Polyhedron&, const Cuts& cuts, const Cuts&) {
    const TiledPolyhedron in_tiles = tiled(a, cuts);
    RC_ASSERT(volume(in_tiles) == volume(a));
    RC_ASSERT(bounding_box(in_tiles) == bounding_box(a));
    RC_ASSERT(volume(complement(in_tiles)) == volume(complement(a)));
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = *adversarial_points().as("point");
      const Location there = locate(in_tiles, p);
      const Location whole = locate(a, p);
      RC_ASSERT((there.mark != 0) == (whole.mark != 0));
      RC_ASSERT(there.kind == whole.kind);
      RC_ASSERT(contains(complement(in_tiles), p) == !contains(a, p));
    }
  });
}

TEST_CASE("sections of sets in tiles are those of the whole set") {
  for_all_cut_pairs("sections", 4, [](const Polyhedron& a, const Polyhedron&, const Cuts& cuts, const Cuts&) {
    const TiledPolyhedron in_tiles = tiled(a, cuts);
    const Rational3 p = *adversarial_points().as("point");
    for (const Rational3& normal : {Rational3{1, 0, 0}, Rational3{0, 0, -2}, Rational3{1, 2, -1}}) {
      const Rational offset = -dot(normal, p);
      const Section cut = section(in_tiles, normal, offset);
      const Section whole = section(a, normal, offset);
      RC_ASSERT(equal(cut.set, whole.set));
      RC_ASSERT(cut.polygons.size() == whole.polygons.size());
      RC_ASSERT(cut.segments.size() == whole.segments.size());
      RC_ASSERT(cut.points.size() == whole.points.size());
      RC_ASSERT(cut.unbounded == whole.unbounded);
    }
  });
  CHECK_THROWS_AS(section(TiledPolyhedron(), {0, 0, 0}, 1), InputError);
}

TEST_CASE("rays through tiles meet what they meet in the whole") {
  for_all_cut_pairs("rays", 4, [](const Polyhedron& a, const Polyhedron&, const Cuts& cuts, const Cuts&) {
    const TiledPolyhedron in_tiles = tiled(a, cuts);
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = *adversarial_points().as("origin");
      const auto coordinate = rc::gen::inRange(-2, 3);
      const Rational3 d{*coordinate, *coordinate, *coordinate};
      if (d[0] == 0 && d[1] == 0 && d[2] == 0) continue;
      // All items, then those of the set, or those that are no edges.
      const int chosen = *rc::gen::inRange(0, 3);
      const auto accept = [chosen](const Location& at) {
        return chosen == 0 || (chosen == 1 ? at.mark != 0 : at.kind != Location::Kind::kEdge);
      };
      const std::optional<RayHit> there = shoot_ray(in_tiles, p, d, accept);
      const std::optional<RayHit> whole = shoot_ray(a, p, d, accept);
      RC_ASSERT(there.has_value() == whole.has_value());
      if (!whole) continue;
      RC_ASSERT(there->point == whole->point);
      RC_ASSERT(there->location.kind == whole->location.kind);
      RC_ASSERT((there->location.mark != 0) == (whole->location.mark != 0));
    }
  });
  CHECK_THROWS_AS(shoot_ray(TiledPolyhedron(), {0, 0, 0}, {0, 0, 0}), InputError);
}

TEST_CASE("a ray in one plane of an edge crosses the edge") {
  const Polyhedron set =
      unite(boundary(make_halfspace(1, 0, 1, 0)), complement(boundary(make_halfspace(1, 1, -1, -3))));
  const TiledPolyhedron in_tiles = tiled(set, Cuts{{{Cut{0, 0}, 0}}});
  const std::optional<RayHit> there =
      shoot_ray(in_tiles, {Rational(1, 2), Rational(-1, 2), Rational(-1, 2)}, {2, -2, -2});
  REQUIRE(there);
  CHECK(there->point == Rational3{3, -3, -3});
  CHECK(there->location.kind == Location::Kind::kEdge);
  CHECK(there->location.mark == 1);
}

TEST_CASE("any Boolean function of sets in tiles") {
  for_all_cut_pairs("functions", 3, [](const Polyhedron& a, const Polyhedron& b, const Cuts& of_a, const Cuts& of_b) {
    const unsigned table = *rc::gen::inRange(0U, 16U);
    const std::array<bool, 4> f{(table & 1U) != 0, (table & 2U) != 0, (table & 4U) != 0, (table & 8U) != 0};
    const Polyhedron plain = overlay(a, b, [&f](LabelId x, LabelId y) {
      return static_cast<LabelId>(f[2U * (x != 0 ? 1U : 0U) + (y != 0 ? 1U : 0U)] ? 1 : 0);
    });
    glued_is(overlay(tiled(a, of_a), tiled(b, of_b), f), plain, "both in tiles");
    glued_is(overlay(tiled(a, of_a), b, f), plain, "one in tiles");
  });
}

TEST_CASE("other operations on sets in tiles") {
  for_all_cut_pairs("unary", 3, [](const Polyhedron& a, const Polyhedron&, const Cuts& cuts, const Cuts&) {
    const TiledPolyhedron x = tiled(a, cuts);
    glued_is(interior(x), interior(a), "interior");
    glued_is(closure(x), closure(a), "closure");
    glued_is(boundary(x), boundary(a), "boundary");
    glued_is(exterior(x), exterior(a), "exterior");
    glued_is(regularize(x), regularize(a), "regularize");
    AffineMap turned;  // y, -2z, x/3, moved
    turned.linear[0][1] = 1;
    turned.linear[1][2] = -2;
    turned.linear[2][0] = Rational(1, 3);
    turned.translation = {Rational(1, 7), 2, -1};
    glued_is(transform(x, turned), transform(a, turned), "axes to axes");
    AffineMap sheared = AffineMap::identity();
    sheared.linear[0][1] = 2;
    glued_is(transform(complement(x), sheared), transform(complement(a), sheared), "sheared");
  });
}

}  // namespace nef::test
