// SPDX-License-Identifier: Apache-2.0
//
// Morphology against its definitions, point by point and by Booleans alone, and against closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "apps/minkowski/morphology.h"
#include "apps/program/expression/expression.h"
#include "nef/geometry/vectors.h"
#include "tests/support/literals.h"
#include "tests/support/numbers/hard_points.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace {

using nef::dot;
using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::minkowski_sum;
using nef::minkowski::Side;
using nef::test::moved;
using nef::test::Recipe;
using nef::test::recipes;
using nef::test::set;
using nef::test::valid;

TEST_CASE("erosion is its definition, for sets of all kinds, with bounded complement, too") {
  CHECK(rc::check("erosion", [] {
    const Recipe recipe = *recipes(true, 3);
    const Polyhedron a = *rc::gen::arbitrary<bool>() ? complement(recipe.make()) : recipe.make();
    const Polyhedron b = (*recipes(true, 2)).make();
    const Polyhedron eroded = valid(nef::minkowski::erode(a, b), "erosion");
    for (int i = 0; i < 10; ++i) {
      Rational3 x = *nef::test::adversarial_points();
      for (Rational& c : x) c -= 2;
      RC_ASSERT(contains(eroded, x) == subtract(moved(b, x), a).is_empty());
    }
  }));
}

TEST_CASE("sums with sets of bounded complement are their definition") {
  CHECK(rc::check("sum with a bounded complement", [] {
    const Polyhedron a = complement((*recipes(true, 3)).make());
    const Polyhedron b = (*recipes(true, 2)).make();
    const Polyhedron sum = valid(minkowski_sum(a, b), "sum");
    const Polyhedron turned = nef::minkowski::negate(b);
    for (int i = 0; i < 10; ++i) {
      const Rational3 x = *nef::test::adversarial_points();
      RC_ASSERT(contains(sum, x) == !intersect(a, moved(turned, x)).is_empty());
    }
    RC_ASSERT(equal(sum, minkowski_sum(b, a)));
  }));
}

TEST_CASE("what is unbounded does not fit into a hole") {
  const Polyhedron a = set("!box(0,0,0,9,9,9)");
  CHECK(minkowski_sum(a, set("halfspace(1,0,0,0) * halfspace(0,1,0,0) * halfspace(0,0,1,0)")).is_everything());
  CHECK(minkowski_sum(a, a).is_everything());
  // The closed box fits into the closed hole in one way, and not into the open one.
  CHECK(equal(minkowski_sum(a, set("box(0,0,0,9,9,9)")), set("!point(9,9,9)")));
  CHECK(equal(minkowski_sum(a, set("box(-9,-9,-9,0,0,0)")), set("!point(0,0,0)")));
  CHECK(minkowski_sum(closure(a), set("box(-9,-9,-9,0,0,0)")).is_everything());
}

TEST_CASE("opening and closing: their definitions, and each is the other's complement") {
  CHECK(rc::check("opening", [] {
    const Polyhedron a = (*recipes(true, 3)).make();
    const Polyhedron b = (*recipes(true, 1)).make();
    if (b.is_empty()) return;
    const Polyhedron open = nef::minkowski::opening(a, b);
    RC_ASSERT(subtract(open, a).is_empty());
    RC_ASSERT(equal(nef::minkowski::opening(open, b), open));
    const Polyhedron close = nef::minkowski::closing(a, b);
    RC_ASSERT(subtract(a, close).is_empty());
    RC_ASSERT(equal(complement(close), nef::minkowski::opening(complement(a), nef::minkowski::negate(b))));
  }));
  // A square with a thin whisker loses it, one with a thin slot has it filled.
  const Polyhedron tool = set("box(0,0,0,1,1,1)");
  CHECK(equal(nef::minkowski::opening(set("box(0,0,0,4,4,4) + box(4,1,1,9,3/2,3)"), tool), set("box(0,0,0,4,4,4)")));
  CHECK(equal(nef::minkowski::closing(set("box(0,0,0,4,4,4) - interior(box(1,1,-1,3/2,5,5))"), tool),
              set("box(0,0,0,4,4,4)")));
  CHECK_THROWS_AS(nef::minkowski::opening(tool, Polyhedron()), nef::InputError);
}

// n . x = c for the plane of a face, n not normalized.
struct FacePlane {
  Rational3 n;
  Rational c;
};
FacePlane plane_of(const nef::Mesh& mesh, std::size_t f) {
  const auto face = mesh.face(f);
  const Rational3& o = mesh.vertices[face[0]];
  const Rational3 n = nef::test::detail::cross(nef::test::detail::minus(mesh.vertices[face[1]], o),
                                               nef::test::detail::minus(mesh.vertices[face[2]], o));
  return {n, dot(n, o)};
}

TEST_CASE("balls are where they say they are") {
  for (const int splits : {1, 2, 3, 8}) {
    for (const char* text : {"1", "7/3", "1/1000"}) {
      const Rational r(text);
      for (const Side side : {Side::kInner, Side::kOuter}) {
        const nef::minkowski::BallApproximation ball = nef::minkowski::ball_approximation(r, splits, side);
        const Rational near = side == Side::kInner ? Rational(r - ball.error) : r;
        const Rational far = side == Side::kInner ? r : Rational(r + ball.error);
        const nef::Mesh& mesh = ball.cell.mesh;
        CHECK(mesh.vertices.size() == static_cast<std::size_t>(4 * splits * splits + 2));
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
          const FacePlane p = plane_of(mesh, f);
          CHECK(p.c > 0);
          CHECK(p.c * p.c >= near * near * dot(p.n, p.n));
        }
        for (const Rational3& v : mesh.vertices) CHECK(dot(v, v) <= far * far);
        CHECK(ball.error * (splits == 1 ? 1 : splits * splits) < 2 * r);
      }
    }
  }
  CHECK_THROWS_AS(nef::minkowski::ball_approximation(0, 2, Side::kOuter), nef::InputError);
  CHECK_THROWS_AS(nef::minkowski::ball_approximation(1, 0, Side::kOuter), nef::InputError);
}

TEST_CASE("offsets enclose the exact one") {
  const Polyhedron a = set("box(0,0,0,4,4,4) - interior(box(1,1,1,9,3,9))");
  for (const char* radius : {"1/2", "-1/4"}) {
    const Polyhedron inner = nef::minkowski::offset(a, Rational(radius), 2, Side::kInner);
    const Polyhedron outer = nef::minkowski::offset(a, Rational(radius), 2, Side::kOuter);
    CHECK(subtract(inner, outer).is_empty());
    CHECK(!subtract(outer, inner).is_empty());
  }
  // Along axes a ball's extent is exact inside, and a little more outside: at the middle of a face the offset is sharp.
  const Polyhedron grown = nef::minkowski::offset(set("box(-9,-9,-9,9,9,9)"), 1, 3, Side::kInner);
  CHECK(contains(grown, {10, 0, 0}));
  CHECK(!contains(grown, {10, 10, 0}));
  // 0.99 from the edge, where the chord of the inner ball is 0.95 from its centre.
  const Rational3 diagonal = {Rational(97, 10), Rational(97, 10), 0};
  CHECK(!contains(grown, diagonal));
  CHECK(contains(nef::minkowski::offset(set("box(-9,-9,-9,9,9,9)"), 1, 3, Side::kOuter), diagonal));
  const Polyhedron shrunk = nef::minkowski::offset(set("box(-9,-9,-9,9,9,9)"), -1, 3, Side::kOuter);
  CHECK(equal(shrunk, set("box(-8,-8,-8,8,8,8)")));
  CHECK(equal(nef::minkowski::offset(a, 0, 3, Side::kOuter), a));
}

TEST_CASE("sweeps along a polyline") {
  const Polyhedron a = set("box(0,0,0,1,1,1)");
  const std::vector<Rational3> path = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}};
  CHECK(equal(nef::minkowski::sweep(a, path), set("box(0,0,0,4,1,1) + box(3,0,0,4,3,1)")));
  CHECK(equal(nef::minkowski::sweep(a, std::vector<Rational3>{{5, 0, 0}}), set("box(5,0,0,6,1,1)")));
  CHECK_THROWS_AS(nef::minkowski::sweep(a, {}), nef::InputError);
}

TEST_CASE("hulls with their marks") {
  const auto hull_of = [](const std::string& text) { return nef::minkowski::hull(set(text)); };
  CHECK(equal(hull_of("point(0,0,0) + point(2,0,0)"), set("segment(0,0,0, 2,0,0)")));
  CHECK(equal(hull_of("box(0,0,0,1,1,1) - point(1,1,1)"), set("box(0,0,0,1,1,1) - point(1,1,1)")));
  CHECK(equal(hull_of("box(0,0,0,1,1,1) - point(1,1,1/2)"), set("box(0,0,0,1,1,1)")));
  CHECK(equal(hull_of("interior(box(0,0,0,3,1,1) + box(0,0,0,1,3,1))"),
              set("interior(hull(0,0,0, 3,0,0, 3,1,0, 1,3,0, 0,3,0, 0,0,1, 3,0,1, 3,1,1, 1,3,1, 0,3,1))")));
  // An open box and one point of its boundary, inside a facet: of the facet only the point belongs to the hull.
  CHECK(equal(hull_of("interior(box(0,0,0,2,2,2)) + point(1,1,2)"), set("interior(box(0,0,0,2,2,2)) + point(1,1,2)")));
  CHECK(equal(hull_of("interior(box(0,0,0,2,2,2)) + point(0,1,2) + point(2,1,2)"),
              set("interior(box(0,0,0,2,2,2)) + segment(0,1,2, 2,1,2)")));
  CHECK(hull_of("nothing").is_empty());
  CHECK(rc::check("hull", [] {
    const Polyhedron a = (*recipes(true, 3)).make();
    const Polyhedron h = valid(nef::minkowski::hull(a), "hull");
    RC_ASSERT(subtract(a, h).is_empty());
    RC_ASSERT(nef::minkowski::is_convex(h));
    RC_ASSERT(equal(nef::minkowski::hull(closure(a)), closure(h)));
    // Extreme points belong to the hull iff they do to the set.
    const nef::Complex& c = h.complex();
    for (const nef::VertexId v : c.vertex_ids()) {
      const Rational3 p = c.points.rational(nef::point_of(v));
      RC_ASSERT(contains(h, p) == contains(a, p));
    }
  }));
}

TEST_CASE("a solid that is convex but for rounding is noticed, one with a slit is told by its volume, others are not") {
  CHECK(!nef::minkowski::excess_of_hull(set("box(0,0,0,1,1,1)")));
  CHECK(!nef::minkowski::excess_of_hull(set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1)")));
  CHECK(!nef::minkowski::excess_of_hull(set("halfspace(1,0,0,0)")));
  CHECK(!nef::minkowski::excess_of_hull(set("polygon(0,0,0, 1,0,0, 0,1,0)")));
  // A dent of 10^-15 in the top of a box.
  const std::optional<Rational> excess = nef::minkowski::excess_of_hull(
      set("box(0,0,0,1,1,1) - interior(hull(0,0,1, 1,0,1, 0,1,1, 1,1,1, 1/2,1/2,999999999999999/1000000000000000))"));
  REQUIRE(excess);
  CHECK(*excess == Rational(1, 3) / Rational("1000000000000000"));
}

TEST_CASE("penetration: boxes, contact, and the way to contact") {
  using Kind = nef::minkowski::Penetration::Kind;
  const Polyhedron a = set("box(0,0,0,4,4,4)");
  const auto p = [&](const std::string& b) { return nef::minkowski::penetration(a, set(b)); };
  const nef::minkowski::Penetration deep = p("box(3,1,1,5,2,2)");
  CHECK(deep.kind == Kind::kOverlapping);
  CHECK(deep.translation == Rational3{1, 0, 0});
  CHECK(deep.squared_length == 1);
  CHECK(p("box(4,4,4,5,5,5)").kind == Kind::kTouching);
  const nef::minkowski::Penetration far = p("box(7,8,0,9,9,1)");
  CHECK(far.kind == Kind::kDisjoint);
  CHECK(far.squared_length == 25);
  CHECK(far.translation == Rational3{-3, -4, 0});
  // Out of a cavity: a slot that is too narrow to leave by does not count, and the way out may be through walls.
  CHECK(p("box(1,1,1,2,2,2)").squared_length == 4);
  // An oblique way: the corner of a cube cut by a plane.
  const nef::minkowski::Penetration oblique =
      nef::minkowski::penetration(set("hull(0,0,0, 3,0,0, 0,3,0, 0,0,3)"), set("box(9/10,9/10,9/10,10,10,10)"));
  CHECK(oblique.kind == Kind::kOverlapping);
  CHECK(oblique.translation == Rational3{Rational(1, 10), Rational(1, 10), Rational(1, 10)});
  CHECK_THROWS_AS(p("nothing"), nef::InputError);
  CHECK_THROWS_AS(p("halfspace(1,0,0,0)"), nef::UnsupportedError);
}

TEST_CASE("penetration: after the translation the sets touch, and no shorter one of a fan does") {
  CHECK(rc::check("penetration", [] {
    const Polyhedron a = regularize((*recipes(true, 2)).make());
    const Polyhedron b = regularize((*recipes(true, 2)).make());
    if (a.is_empty() || b.is_empty()) return;
    const nef::minkowski::Penetration p = nef::minkowski::penetration(a, b);
    const auto overlap = [&](const Rational3& by) {
      return !intersect(interior(a), interior(moved(b, by))).is_empty();
    };
    const auto meet = [&](const Rational3& by) { return !intersect(closure(a), closure(moved(b, by))).is_empty(); };
    RC_ASSERT(!overlap(p.translation));
    RC_ASSERT(meet(p.translation));
    RC_ASSERT(dot(p.translation, p.translation) == p.squared_length);
    using Kind = nef::minkowski::Penetration::Kind;
    const Rational3 zero;
    RC_ASSERT(overlap(zero) == (p.kind == Kind::kOverlapping));
    RC_ASSERT(meet(zero) == (p.kind != Kind::kDisjoint));
    for (int i = 0; i < 8; ++i) {
      Rational3 d = *nef::test::adversarial_points();
      for (Rational& x : d) x -= 2;
      if (dot(d, d) >= p.squared_length) continue;
      const bool shorter_is_no_contact = p.kind == Kind::kOverlapping ? overlap(d) : !meet(d);
      RC_ASSERT(shorter_is_no_contact);
    }
  }));
}

// The nearest way out leads into a passage that is exactly as wide as what moves: a shaft, from which it can go on
// along a line; a hole, in which it can not move at all; two octants that meet in a point, around which the other set
// has the rest of space, so that no facet of the convolution tells of the contact.
TEST_CASE("penetration: into a shaft, a hole and a saddle of exactly the right size") {
  const auto way_out = [](const std::string& a, const std::string& b, const Rational3& by) {
    nef::minkowski::MinkowskiReport report;
    const nef::minkowski::Penetration p = nef::minkowski::penetration(set(a), moved(set(b), by), {}, &report);
    CHECK(p.kind == nef::minkowski::Penetration::Kind::kOverlapping);
    CHECK(report.choices.back().why == "depth found from facets near the origin");
    return p.translation;
  };
  const std::string cube = "box(1,1,1, 2,2,2)";
  CHECK(way_out("box(0,0,0, 3,3,9) - box(1,1,0, 2,2,9)", cube, {Rational(1, 5), Rational(-1, 7), 3}) ==
        Rational3{Rational(-1, 5), Rational(1, 7), 0});
  CHECK(way_out("box(0,0,0, 3,3,3) - box(1,1,1, 2,2,2)", cube, {Rational(1, 5), Rational(-1, 7), Rational(1, 9)}) ==
        Rational3{Rational(-1, 5), Rational(1, 7), Rational(-1, 9)});
  // A point missing inside changes nothing, nor does a facet.
  CHECK(way_out("box(0,0,0, 3,3,3) - box(1,1,1, 2,2,2) - polygon(0,0,1/2, 3,0,1/2, 3,3,1/2, 0,3,1/2) - point(2,2,5/2)",
                cube, {Rational(1, 5), Rational(-1, 7), Rational(1, 9)}) ==
        Rational3{Rational(-1, 5), Rational(1, 7), Rational(-1, 9)});
  CHECK(way_out("box(0,0,0, 2,2,2) + box(-2,-2,-2, 0,0,0)",
                "regularize(box(-1,-1,-1, 1,1,1) - box(0,0,0, 1,1,1) - box(-1,-1,-1, 0,0,0))",
                {Rational(1, 10), Rational(1, 20), Rational(-1, 10)}) ==
        Rational3{Rational(-1, 10), Rational(-1, 20), Rational(1, 10)});
}

void check_ways_out(const Polyhedron& a, const Polyhedron& b) {
  nef::minkowski::MinkowskiOptions cells;
  cells.strategy = nef::minkowski::UnionStrategy::kQueue;
  nef::minkowski::MinkowskiOptions threads;
  threads.monitor = nef::Monitor().on_threads(3);
  const nef::minkowski::Penetration near = nef::minkowski::penetration(a, b);
  RC_ASSERT(near.squared_length == nef::minkowski::penetration(a, b, cells).squared_length);
  RC_ASSERT(near.translation == nef::minkowski::penetration(a, b, threads).translation);
}

TEST_CASE("penetration: facets near the origin tell what the whole sum of cells tells") {
  CHECK(rc::check("on a grid", [] {
    const Polyhedron a = regularize((*recipes(true, 4)).make());
    const Polyhedron b = regularize((*recipes(true, 3, 2)).make());
    if (!a.is_empty() && !b.is_empty()) check_ways_out(a, b);
  }));
  // Sheared by next to nothing, so that doubles can not tell.
  nef::AffineMap turn = nef::AffineMap::identity();
  turn.linear = {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}};
  nef::AffineMap nearly = turn;
  nearly.linear[0][1] += Rational(1, 3) / Rational(nef::Integer(1) << 60U);
  CHECK(rc::check("turned", [&] {
    const Polyhedron a = regularize((*recipes(true, 4)).make());
    const Polyhedron b = regularize((*recipes(true, 3, 2)).make());
    if (!a.is_empty() && !b.is_empty()) check_ways_out(transform(a, turn), transform(b, nearly));
  }));
}

TEST_CASE("no-fit sets: contact without overlap, tight slots included") {
  const Polyhedron part = set("box(0,0,0,3,3,1) - interior(box(1,1,-1,2,4,2))");
  const Polyhedron key = set("box(0,0,0,1,1,1)");
  const Polyhedron contact = nef::minkowski::no_fit_set(part, key);
  CHECK(*nef::volume(contact) == 0);
  CHECK(contains(contact, {1, 2, 0}));  // in the slot, as wide as the key
  CHECK(contains(contact, {1, 1, 0}));  // at its end
  CHECK(!contains(contact, {Rational(11, 10), 2, 0}));
  CHECK(contains(contact, {3, 0, 0}));
  CHECK(!contains(contact, {4, 0, 0}));
  CHECK(rc::check("no-fit set", [] {
    const Polyhedron a = (*recipes(true, 2)).make();
    const Polyhedron b = (*recipes(true, 2)).make();
    const Polyhedron n = nef::minkowski::no_fit_set(a, b);
    for (int i = 0; i < 10; ++i) {
      Rational3 t = *nef::test::adversarial_points();
      for (Rational& x : t) x -= 2;
      const Polyhedron there = moved(b, t);
      const bool fits =
          !intersect(closure(a), closure(there)).is_empty() && intersect(interior(a), interior(there)).is_empty();
      RC_ASSERT(contains(n, t) == fits);
    }
  }));
}

TEST_CASE("components: joined by points and edges, or not") {
  const auto at = [](const std::string& text, const Rational3& p) {
    return valid(nef::minkowski::component_of(set(text), p), "component");
  };
  const std::string two = "box(0,0,0,1,1,1) + box(2,0,0,3,1,1)";
  CHECK(equal(at(two, {0, 0, 0}), set("box(0,0,0,1,1,1)")));
  CHECK(at(two, {Rational(3, 2), 0, 0}).is_empty());
  CHECK(equal(at(two + " + segment(1,1,1, 2,1,1)", {0, 0, 0}), set(two + " + segment(1,1,1, 2,1,1)")));
  CHECK(equal(at(two + " + segment(1,1,1, 2,1,1) - point(3/2,1,1)", {0, 0, 0}),
              set("box(0,0,0,1,1,1) + segment(1,1,1, 3/2,1,1) - point(3/2,1,1)")));
  const std::string corners = "box(0,0,0,1,1,1) + box(1,1,1,2,2,2)";
  CHECK(equal(at(corners, {0, 0, 0}), set(corners)));
  CHECK(equal(at("(" + corners + ") - point(1,1,1)", {0, 0, 0}), set("box(0,0,0,1,1,1) - point(1,1,1)")));
  // Open boxes that share a facet are apart; with one point of it they are not.
  const std::string open = "interior(box(0,0,0,1,1,1)) + interior(box(1,0,0,2,1,1))";
  const Rational half(1, 2);
  CHECK(equal(at(open, {half, half, half}), set("interior(box(0,0,0,1,1,1))")));
  CHECK(equal(at(open + " + point(1,1/2,1/2)", {half, half, half}), set(open + " + point(1,1/2,1/2)")));
  // A point in a cavity is not joined to the walls; the outside is what is beyond all finite points.
  const Polyhedron room = set("!(box(0,0,0,3,3,3) - box(1,1,1,2,2,2))");
  CHECK(equal(nef::minkowski::component_of(room, std::nullopt), set("!box(0,0,0,3,3,3)")));
  CHECK(equal(nef::minkowski::component_of(room, Rational3{Rational(3, 2), Rational(3, 2), Rational(3, 2)}),
              set("box(1,1,1,2,2,2)")));
  CHECK(nef::minkowski::component_of(set("box(0,0,0,1,1,1)"), std::nullopt).is_empty());
  CHECK(equal(nef::minkowski::component_of(set("halfspace(1,0,0,0) + box(5,0,0,6,1,1)"), std::nullopt),
              set("halfspace(1,0,0,0)")));
}

TEST_CASE("reach: a tool gets into a slot as wide as itself, not into a narrower one, nor into a cavity") {
  // A block with a slot of width 1 (from above), one of width 1/2, and a cavity.
  const Polyhedron part = set(
      "box(0,0,0,9,3,3) - interior(box(1,-1,1,2,9,9)) - interior(box(4,-1,1,9/2,9,9)) - interior(box(6,1,1,8,2,2))");
  const Polyhedron tool = set("box(0,0,0,1,1,1)");
  const nef::minkowski::Reach found = nef::minkowski::reach(tool, part);
  CHECK(contains(found.positions, {1, 0, 1}));  // at the bottom of the slot
  CHECK(!contains(found.positions, {6, 1, 1}));
  CHECK(contains(found.touched, {1, 1, 2}));
  CHECK(contains(found.touched, {Rational(3, 2), 1, 1}));
  CHECK(contains(found.untouched, {4, 1, 2}));
  CHECK(contains(found.untouched, {6, Rational(3, 2), Rational(3, 2)}));
  CHECK(equal(unite(found.touched, found.untouched), boundary(part)));
  CHECK(intersect(found.touched, found.untouched).is_empty());
  CHECK(equal(closure(found.untouched), set("box(4,0,1,4,3,3) + box(9/2,0,1,9/2,3,3) + box(4,0,1,9/2,3,1) + "
                                            "boundary(box(6,1,1,8,2,2))")));
  const nef::minkowski::Reach inside = nef::minkowski::reach(tool, part, Rational3{6, 1, 1});
  CHECK(equal(inside.positions, set("box(6,1,1,7,1,1)")));
  CHECK(contains(inside.touched, {7, 1, Rational(3, 2)}));
  CHECK_THROWS_AS(nef::minkowski::reach(tool, part, Rational3{0, 0, 0}), nef::InputError);
}

TEST_CASE("hulls of unbounded sets") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"halfspace(1,0,0,0)", "halfspace(1,0,0,0)"},
      {"interior(halfspace(1,0,0,0))", "interior(halfspace(1,0,0,0))"},
      {"halfspace(1,0,0,0) + point(2,0,0)", "interior(halfspace(1,0,0,-2)) + point(2,0,0)"},
      {"!box(0,0,0,1,1,1)", "everything"},
      {"halfspace(1,0,0,0) + halfspace(0,1,0,0)", "everything"},
      {"(halfspace(1,0,0,0) - halfspace(1,0,0,2)) + (halfspace(1,0,0,-4) - halfspace(1,0,0,-3))",
       "halfspace(1,0,0,-4) - halfspace(1,0,0,2)"},
      {"boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0)) + point(0,1,0)",
       "boundary(halfspace(0,0,1,0)) * interior(halfspace(0,1,0,-1)) * interior(halfspace(0,-1,0,0)) +"
       "boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0)) + point(0,1,0)"},
      {"halfspace(-1,0,0,0) * boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0)) + point(5,1,0)",
       "halfspace(-1,0,0,0) * boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0)) + segment(0,0,0, 5,1,0) +"
       "boundary(halfspace(0,0,1,0)) * halfspace(-1,5,0,0) * interior(halfspace(0,1,0,-1)) *"
       "interior(halfspace(0,-1,0,0))"},
      {"(halfspace(1,0,0,0) * halfspace(0,1,0,0) * halfspace(0,0,1,0)) - box(-2,-2,-2,1,1,1)",
       "(halfspace(1,0,0,0) * halfspace(0,1,0,0) * halfspace(0,0,1,0)) - hull(-2,0,0,0,-2,0,0,0,-2,0,0,0)"}};
  for (const auto& [of, expected] : cases) {
    CAPTURE(of);
    CHECK(nef::equal(valid(nef::minkowski::hull(set(of)), "hull"), set(expected)));
  }
  CHECK(rc::check("unbounded hulls", [] {
    const Polyhedron a = (*recipes(false, 3)).make();
    const Polyhedron h = valid(nef::minkowski::hull(a), "hull");
    RC_ASSERT(subtract(a, h).is_empty());
    RC_ASSERT(subtract(nef::minkowski::hull(intersect(a, set("box(-50,-50,-50,50,50,50)"))), h).is_empty());
    // Convex, marks included: with any two points it has the point between them.
    const Polyhedron between =
        transform(minkowski_sum(h, h), nef::AffineMap::scale({Rational(1, 2), Rational(1, 2), Rational(1, 2)}));
    RC_ASSERT(equal(between, h));
  }));
}

TEST_CASE("hulls of unbounded sets in expressions") {
  nef::ExpressionOptions options;
  const std::string text = "hull(halfspace(0,0,1,0), point(1,2,5))";
  CHECK_THROWS_AS(nef::evaluate_expression(text, options), nef::ExpressionError);
  options.hull = nef::minkowski::hull;
  const Polyhedron below_five = nef::interior(nef::make_halfspace(0, 0, 1, -5));
  CHECK(equal(nef::evaluate_expression(text, options), unite(below_five, nef::make_point({1, 2, 5}))));
  const Polyhedron unit_box = nef::make_box({0, 0, 0}, {1, 1, 1});
  CHECK(equal(nef::evaluate_expression("hull(interior(box(0,0,0,1,1,1)))", options), unit_box));
}

}  // namespace
