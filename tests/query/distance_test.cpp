// SPDX-License-Identifier: Apache-2.0
//
// Distances by certificates: p in A and q in B are nearest points of two closed convex sets if no point of A lies
// beyond the plane through p across q - p, and none of B before the one through q. Sets that are not convex are unions
// of convex ones.
#include "nef/distance/distance.h"

#include "tests/laws/laws.h"

namespace nef {
namespace {

using test::set;
using test::detail::dot;
using test::detail::minus;

// True if the answer is proven for the hulls of two sets of points.
bool certified(const Distance& answer, const std::vector<Rational3>& a, const std::vector<Rational3>& b) {
  const Rational3 v = minus(answer.on_b, answer.on_a);
  if (answer.squared != dot(v, v)) return false;
  for (const Rational3& x : a) {
    if (dot(minus(x, answer.on_a), v) > 0) return false;
  }
  for (const Rational3& y : b) {
    if (dot(minus(y, answer.on_b), v) < 0) return false;
  }
  return true;
}

std::vector<Rational3> some_points(int low, int high, int most) {
  std::vector<Rational3> points(static_cast<std::size_t>(*rc::gen::inRange(1, most)));
  for (Rational3& p : points) {
    for (Rational& x : p) x = Rational(*rc::gen::inRange(2 * low, 2 * high)) / 2;
  }
  return points;
}

}  // namespace

TEST_CASE("distances of convex sets are certified") {
  CHECK(rc::check("hulls", [] {
    const std::vector<Rational3> a = some_points(0, 5, 9);
    std::vector<Rational3> b = some_points(0, 5, 9);
    const auto axis = *rc::gen::inRange<std::size_t>(0, 3);
    for (Rational3& p : b) p[axis] += *rc::gen::element(0, 3, 6);
    const Polyhedron hull_a = convex_hull(a);
    const Polyhedron hull_b = convex_hull(b);
    const std::optional<Distance> answer = distance(hull_a, hull_b);
    RC_ASSERT(answer.has_value());
    RC_ASSERT(contains(hull_a, answer->on_a));
    RC_ASSERT(contains(hull_b, answer->on_b));
    RC_ASSERT(certified(*answer, a, b));
    RC_ASSERT((answer->squared == 0) == answer->common_point);
    RC_ASSERT((answer->squared > 0) == (answer->contact == Contact::kDisjoint));
    const std::optional<Distance> back = distance(hull_b, hull_a);
    RC_ASSERT(back->squared == answer->squared);
    RC_ASSERT(back->contact == answer->contact);
    // Without its boundary a solid is as near, but touches nothing.
    if (const Polyhedron open = interior(hull_a); !open.is_empty()) {
      const std::optional<Distance> from_open = distance(open, hull_b);
      RC_ASSERT(from_open->squared == answer->squared);
      RC_ASSERT(from_open->contact == answer->contact);
      RC_ASSERT(from_open->common_point == !intersect(open, hull_b).is_empty());
    }
  }));
}

TEST_CASE("distances of unions of convex sets are the least of their parts") {
  CHECK(rc::check("unions", [] {
    std::vector<std::vector<Rational3>> parts_a;
    std::vector<std::vector<Rational3>> parts_b;
    Polyhedron a;
    Polyhedron b;
    for (int i = 0; i < 3; ++i) {
      parts_a.push_back(some_points(0, 4, 6));
      parts_b.push_back(some_points(4, 8, 6));
      a = unite(a, convex_hull(parts_a.back()));
      b = unite(b, convex_hull(parts_b.back()));
    }
    const std::optional<Distance> whole = distance(a, b);
    RC_ASSERT(whole.has_value());
    RC_ASSERT(contains(a, whole->on_a));
    RC_ASSERT(contains(b, whole->on_b));
    std::optional<Rational> least;
    for (const auto& x : parts_a) {
      for (const auto& y : parts_b) {
        const std::optional<Distance> pair = distance(convex_hull(x), convex_hull(y));
        RC_ASSERT(certified(*pair, x, y));
        if (!least || pair->squared < *least) least = pair->squared;
      }
    }
    RC_ASSERT(whole->squared == *least);
  }));
}

TEST_CASE("a set that surrounds another") {
  const Polyhedron shell = set("box(0,0,0,9,9,9) - interior(box(1,1,1,8,8,8))");
  const std::optional<Distance> inner = distance(shell, set("box(3,3,3,5,6,7)"));
  REQUIRE(inner);
  CHECK(inner->contact == Contact::kDisjoint);
  CHECK(inner->squared == 1);
  CHECK(inner->on_b[2] == 7);
  CHECK(inner->on_a[2] == 8);
  const std::optional<Distance> within = distance(set("box(0,0,0,9,9,9)"), set("box(3,3,3,5,6,7)"));
  CHECK(within->contact == Contact::kOverlapping);
  CHECK(within->squared == 0);
  CHECK(within->on_a == within->on_b);
  CHECK(distance(set("box(0,0,0,9,9,9)"), set("point(1,1,1)"))->contact == Contact::kTouching);
}

TEST_CASE("touching, open and closed") {
  const Polyhedron closed = set("box(0,0,0,1,1,1)");
  const Polyhedron beside = set("box(1,0,0,2,1,1)");
  CHECK(distance(closed, beside)->contact == Contact::kTouching);
  CHECK(distance(closed, beside)->common_point);
  CHECK_FALSE(distance(closed, interior(beside))->common_point);
  CHECK(distance(interior(closed), interior(beside))->squared == 0);
  CHECK(distance(interior(closed), interior(beside))->contact == Contact::kTouching);
  CHECK_FALSE(distance(closed, Polyhedron()));
  CHECK_FALSE(distance(Polyhedron(), closed));
  CHECK(distance(set("point(0,0,0)"), set("point(1,2,2)"))->value() == 3);
  CHECK(distance(set("segment(0,0,0,2,0,0)"), set("segment(1,-1,3,1,1,3)"))->squared == 9);
  CHECK(distance(set("segment(0,0,0,2,0,0)"), set("segment(3,0,4,5,0,4)"))->squared == 17);
  CHECK(distance(set("segment(0,0,0,2,0,0)"), set("segment(0,1,0,2,1,0)"))->squared == 1);
  const std::optional<Distance> third = distance(set("hull(0,0,0, 3,0,0, 0,3,0, 0,0,3)"), set("point(2,2,2)"));
  CHECK(third->squared == 3);
  CHECK(third->on_a == Rational3{1, 1, 1});
}

TEST_CASE("sets that reach infinity") {
  const std::optional<Distance> planes = distance(set("halfspace(1,2,2,0)"), set("halfspace(-1,-2,-2,9)"));
  REQUIRE(planes);
  CHECK(planes->squared == 9);  // x + 2y + 2z = 0 and = 9, across (1, 2, 2)
  CHECK(distance(set("halfspace(0,0,1,0)"), set("halfspace(0,0,-1,0)"))->contact == Contact::kTouching);
  CHECK(distance(set("halfspace(0,0,1,0)"), set("halfspace(0,1,0,0)"))->contact == Contact::kOverlapping);
  CHECK(distance(Polyhedron::everything(), Polyhedron::everything())->contact == Contact::kOverlapping);
  CHECK(distance(Polyhedron::everything(), set("point(1,2,3)"))->on_a == Rational3{1, 2, 3});
  // Two lines that pass each other; a line and a cube; a wedge and a point before its edge.
  const Polyhedron x_axis = set("boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0))");
  CHECK(distance(x_axis, set("boundary(halfspace(1,0,0,-7)) * boundary(halfspace(0,0,1,-2))"))->squared == 4);
  CHECK(distance(x_axis, set("box(5,3,4,6,7,8)"))->squared == 25);
  const std::optional<Distance> wedge =
      distance(set("halfspace(1,1,0,0) * halfspace(1,-1,0,0)"), set("point(3,0,1000)"));
  CHECK(wedge->squared == 9);
  CHECK(wedge->on_a == Rational3{0, 0, 1000});
  // Nearest far out: almost parallel lines, that come nearest a million away.
  const Polyhedron slanted = set("boundary(halfspace(1,-1000000,0,1000000000000)) * boundary(halfspace(0,0,1,-1))");
  const std::optional<Distance> far =
      distance(set("boundary(halfspace(0,1,0,0)) * boundary(halfspace(0,0,1,0))"), slanted);
  CHECK(far->squared == 1);
  CHECK(far->on_a == Rational3{-1000000000000, 0, 0});
  // The outside of a cube and what is in it.
  CHECK(distance(set("!box(0,0,0,9,9,9)"), set("box(2,3,4,5,6,7)"))->squared == 4);
}

TEST_CASE("coordinates beyond the range of doubles") {
  Integer huge = 1;
  huge <<= 1100;
  const Rational h(huge);
  const std::optional<Distance> apart =
      distance(make_box({h, 0, 0}, {h + 1, 1, 1}), make_box({h + 4, 0, 0}, {h + 5, 1, 1}));
  CHECK(apart->squared == 9);
  CHECK(apart->value() == 3);
  const std::optional<Distance> wide = distance(make_point({0, 0, 0}), make_point({h, 0, 0}));
  CHECK(wide->squared == h * h);
}

}  // namespace nef
