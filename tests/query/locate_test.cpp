// SPDX-License-Identifier: Apache-2.0
//
// Point location, local pyramids and rays against arithmetic: scenes on a small integer grid, of
// which membership of every point is known without any library code.
#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

// A set with its membership test.
struct Piece {
  Polyhedron set;
  std::function<bool(const Rational3&)> holds;
  std::string text;  // the set in the language of `nef eval`
};

std::string text_of(const Rational3& p) { return to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]); }

bool in_range(const Rational& low, const Rational& x, const Rational& high, bool open) {
  return open ? low < x && x < high : low <= x && x <= high;
}

// A box with low <= high: of any dimension if closed.
Piece box_piece(const Rational3& low, const Rational3& high, bool open) {
  Polyhedron set = make_box(low, high);
  if (open) set = interior(set);
  return {set,
          [=](const Rational3& p) {
            return in_range(low[0], p[0], high[0], open) && in_range(low[1], p[1], high[1], open) &&
                   in_range(low[2], p[2], high[2], open);
          },
          (open ? "interior(box(" : "(box(") + text_of(low) + ", " + text_of(high) + "))"};
}

Piece halfspace_piece(const std::array<int, 4>& h, bool closed) {
  return {make_halfspace(h[0], h[1], h[2], h[3], closed),
          [=](const Rational3& p) {
            const Rational value = h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
            return closed ? value <= 0 : value < 0;
          },
          (closed ? "(halfspace(" : "interior(halfspace(") + text_of({h[0], h[1], h[2]}) + "," + std::to_string(h[3]) +
              "))"};
}

Piece combine(const Piece& a, const Piece& b, int operation) {
  const auto f = a.holds;
  const auto g = b.holds;
  const std::string text = "(" + a.text + " " + "+*-^"[operation] + " " + b.text + ")";
  switch (operation) {
    case 0:
      return {unite(a.set, b.set), [=](const Rational3& p) { return f(p) || g(p); }, text};
    case 1:
      return {intersect(a.set, b.set), [=](const Rational3& p) { return f(p) && g(p); }, text};
    case 2:
      return {subtract(a.set, b.set), [=](const Rational3& p) { return f(p) && !g(p); }, text};
    default:
      return {symmetric_difference(a.set, b.set), [=](const Rational3& p) { return f(p) != g(p); }, text};
  }
}

Piece random_piece(bool unbounded) {
  if (unbounded && *rc::gen::inRange(0, 3) == 0) {
    std::array<int, 4> h{*rc::gen::inRange(-2, 3), *rc::gen::inRange(-2, 3), *rc::gen::inRange(-2, 3),
                         *rc::gen::inRange(-4, 5)};
    if (h[0] == 0 && h[1] == 0 && h[2] == 0) h[0] = 1;
    return halfspace_piece(h, *rc::gen::inRange(0, 2) == 0);
  }
  Rational3 low;
  Rational3 high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = *rc::gen::inRange(0, 4);
    high[i] = low[i] + *rc::gen::inRange(0, 4);
  }
  return box_piece(low, high, *rc::gen::inRange(0, 3) == 0);
}

Piece random_scene(bool unbounded) {
  Piece scene = random_piece(unbounded);
  const int pieces = *rc::gen::inRange(1, 5);
  for (int i = 0; i < pieces; ++i) {
    const int roll = *rc::gen::inRange(0, 6);
    scene = combine(scene, random_piece(unbounded), roll < 3 ? 0 : roll - 2);
  }
  return scene;
}

Rational3 random_point() {
  // Mostly on the grid and so on planes, edges and vertices.
  Rational3 p;
  for (Rational& x : p) x = Rational(*rc::gen::inRange(-2, 17)) / 2;
  if (*rc::gen::inRange(0, 3) == 0) p[0] += Rational(1) / 3;
  return p;
}

Rational3 random_direction() {
  Rational3 d;
  for (Rational& x : d) x = *rc::gen::inRange(-2, 3);
  if (d[0] == 0 && d[1] == 0 && d[2] == 0) d[2] = 1;
  return d;
}

Rational3 along(const Rational3& p, const Rational& t, const Rational3& d) {
  return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

Direction to_direction(const Rational3& d) {
  return Direction::exact(d[0].get_num(), d[1].get_num(), d[2].get_num());  // integers here
}

void check_location(bool unbounded) {
  const Piece scene = random_scene(unbounded);
  RC_LOG() << scene.text << "\n";
  for (int i = 0; i < 40; ++i) {
    const Rational3 p = random_point();
    RC_LOG() << "point " << text_of(p) << "\n";
    const Location where = locate(scene.set, p);
    RC_ASSERT((where.mark != 0) == scene.holds(p));
    if (where.kind == Location::Kind::kVertex) {
      RC_ASSERT(scene.set.complex().points.rational(PointId{where.index}) == p);
    }
    // The pyramid tells membership of points nearby. Coordinates have denominators up to 6 and
    // planes small coefficients, so 1/1000 is near enough.
    const SphereMapBuffer pyramid = local_pyramid(scene.set, p);
    RC_ASSERT((pyramid.mark != 0) == scene.holds(p));
    for (int k = 0; k < 4; ++k) {
      const Rational3 d = random_direction();
      const SphereLocation on = locate(scene.set.complex().planes, pyramid.view(), to_direction(d), {});
      RC_ASSERT((mark_at(pyramid.view(), on) != 0) == scene.holds(along(p, Rational(1, 1000), d)));
    }
    // Where the pyramid is not constant, something must have been found there, and only there.
    const bool constant = pyramid.view().trivial() && pyramid.sfaces[0].mark == pyramid.mark;
    RC_ASSERT((where.kind == Location::Kind::kVolume) == constant);
  }
}

void check_rays(bool unbounded) {
  const Piece scene = random_scene(unbounded);
  RC_LOG() << scene.text << "\n";
  for (int i = 0; i < 20; ++i) {
    const Rational3 p = random_point();
    const Rational3 d = random_direction();
    RC_LOG() << "ray " << text_of(p) << " to " << text_of(d) << "\n";
    const std::optional<RayHit> hit = shoot_ray(scene.set, p, d);
    std::size_t axis = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
    // Far enough to be beyond everything finite that the ray can meet.
    const Rational end = hit ? Rational((hit->point[axis] - p[axis]) / d[axis]) : Rational(100);
    RC_ASSERT(end > 0);
    if (hit) {
      RC_ASSERT(along(p, end, d) == hit->point);
      const Location at = locate(scene.set, hit->point);
      RC_ASSERT(at.kind == hit->location.kind);
      RC_ASSERT(at.mark == hit->location.mark);
      if (at.kind == Location::Kind::kEdge) {
        const HalfedgeId other = scene.set.complex().twin[at.halfedge()];
        RC_ASSERT((hit->location.index == at.index || hit->location.halfedge() == other));
      } else {
        RC_ASSERT(hit->location.index == at.index);
      }
    }
    // All points before the hit are in one item, or on one facet or edge along which the ray runs.
    const Location first = locate(scene.set, along(p, end / 97, d));
    for (int k = 2; k < 97; k += 5) {
      const Location next = locate(scene.set, along(p, end * k / 97, d));
      RC_ASSERT(next.kind == first.kind);
      RC_ASSERT(next.index == first.index);
    }
  }
}

}  // namespace

TEST_CASE("locations and local pyramids agree with arithmetic") {
  CHECK(rc::check("bounded", [] { check_location(false); }));
  CHECK(rc::check("unbounded", [] { check_location(true); }));
}

TEST_CASE("rays stop at the first item and at nothing before") {
  CHECK(rc::check("bounded", [] { check_rays(false); }));
  CHECK(rc::check("unbounded", [] { check_rays(true); }));
}

TEST_CASE("a cube: each kind of item, by text") {
  const Polyhedron cube = make_box({0, 0, 0}, {2, 2, 2});
  using Kind = Location::Kind;
  CHECK(locate(cube, {0, 0, 0}).kind == Kind::kVertex);
  CHECK(locate(cube, {1, 0, 0}).kind == Kind::kEdge);
  CHECK(locate(cube, {1, 1, 0}).kind == Kind::kFacet);
  CHECK(locate(cube, {1, 1, 1}).kind == Kind::kVolume);
  CHECK(locate(cube, {1, 1, 1}).mark == 1);
  CHECK(locate(cube, {3, 0, 0}).mark == 0);
  // One part in 10^40 beside the facet: no rounding.
  Rational tiny(1, Integer("10000000000000000000000000000000000000000"));
  CHECK(locate(cube, {1, 1, tiny}).kind == Kind::kVolume);
  CHECK(locate(cube, {1, 1, tiny}).mark == 1);
  CHECK(locate(cube, {1, 1, -tiny}).mark == 0);
  CHECK(locate(cube, {1, tiny, 0}).kind == Kind::kFacet);
}

TEST_CASE("rays skip what they are told to") {
  const Polyhedron two = unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({3, 0, 0}, {4, 1, 1}));
  const Rational3 origin{-1, Rational(1, 2), Rational(1, 2)};
  const std::optional<RayHit> first = shoot_ray(two, origin, {1, 0, 0});
  REQUIRE(first);
  CHECK(first->point[0] == 0);
  const std::uint32_t skip = first->location.index;
  const auto other = shoot_ray(two, origin, {1, 0, 0}, [&](const Location& l) { return l.index != skip; });
  REQUIRE(other);
  CHECK(other->point[0] == 1);
  CHECK_FALSE(shoot_ray(two, origin, {-1, 0, 0}));
  CHECK(shoot_ray(two, {2, Rational(1, 2), Rational(1, 2)}, {1, 0, 0})->point[0] == 3);
}

TEST_CASE("a facet with hundreds of holes is searched, not scanned") {
  // A plate with a grid of square holes; membership of the plate's points by arithmetic.
  constexpr int kHoles = 20;
  std::vector<std::vector<Rational3>> rings{
      {{0, 0, 0}, {2 * kHoles + 1, 0, 0}, {2 * kHoles + 1, 2 * kHoles + 1, 0}, {0, 2 * kHoles + 1, 0}}};
  for (int i = 0; i < kHoles; ++i) {
    for (int j = 0; j < kHoles; ++j) {
      const Rational x = 2 * i + 1;
      const Rational y = 2 * j + 1;
      rings.push_back({{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
    }
  }
  const Polyhedron plate = make_polygon(rings);
  REQUIRE(counts(plate).facets == 1);
  const Stopwatch watch;
  int queries = 0;
  for (int i = 0; i <= 4 * kHoles + 2; i += 3) {
    for (int j = 0; j <= 4 * kHoles + 2; j += 1) {
      const Rational x = Rational(i) / 2;
      const Rational y = Rational(j) / 2;
      const auto in_hole = [](const Rational& c) {
        const double d = c.get_d();
        return d > 1 && d < 2 * kHoles && std::fmod(d, 2) > 1;
      };
      const bool hole = in_hole(x) && in_hole(y);
      const Location where = locate(plate, {x, y, 0});
      ++queries;
      CAPTURE(i, j);
      REQUIRE((where.mark == 0) == hole);
    }
  }
  WARN("a location in a facet with 400 holes takes " << watch.seconds() * 1e6 / queries << " microseconds");
}

}  // namespace nef
