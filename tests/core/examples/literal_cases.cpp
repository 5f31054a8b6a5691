// SPDX-License-Identifier: Apache-2.0
//
// Two sets and what becomes of them, as text: all pairs of dimensions, in every position to each
// other. Counts are vertices/edges/facets/volumes, worked out by hand.
#include <catch2/catch.hpp>

#include "tests/support/literals.h"

namespace nef::test {
namespace {

struct LiteralCase {
  const char* what;
  const char* a;
  const char* b;
  const char* united;
  const char* common;
  const char* difference;  // a - b
};

constexpr const char* kCube = "box(0,0,0,2,2,2)";

// nothing: 0/0/0/1; point: 1/0/0/1; segment: 2/1/0/1; triangle: 3/3/1/1; cube: 8/12/6/2.
const LiteralCase kCases[] = {
    {"point apart from point", "point(0,0,0)", "point(1,0,0)", "2/0/0/1", "0/0/0/1", "1/0/0/1"},
    {"point on point", "point(0,0,0)", "point(0,0,0)", "1/0/0/1", "1/0/0/1", "0/0/0/1"},
    {"point in segment", "segment(0,0,0,2,0,0)", "point(1,0,0)", "2/1/0/1", "1/0/0/1", "3/2/0/1"},
    {"point at the end of a segment", "segment(0,0,0,2,0,0)", "point(0,0,0)", "2/1/0/1", "1/0/0/1", "2/1/0/1"},
    {"point beside a segment", "segment(0,0,0,2,0,0)", "point(3,0,0)", "3/1/0/1", "0/0/0/1", "2/1/0/1"},
    {"point in facet", "polygon(0,0,0,3,0,0,0,3,0)", "point(1,1,0)", "3/3/1/1", "1/0/0/1", "4/3/1/1"},
    {"point on an edge of a facet", "polygon(0,0,0,3,0,0,0,3,0)", "point(1,0,0)", "3/3/1/1", "1/0/0/1", "4/4/1/1"},
    {"point above a facet", "polygon(0,0,0,3,0,0,0,3,0)", "point(1,1,1)", "4/3/1/1", "0/0/0/1", "3/3/1/1"},
    {"point in volume", kCube, "point(1,1,1)", "8/12/6/2", "1/0/0/1", "9/12/6/2"},
    {"point in a facet of a cube", kCube, "point(1,1,2)", "8/12/6/2", "1/0/0/1", "9/12/6/2"},
    {"point in an edge of a cube", kCube, "point(1,2,2)", "8/12/6/2", "1/0/0/1", "9/13/6/2"},
    {"point at a corner of a cube", kCube, "point(2,2,2)", "8/12/6/2", "1/0/0/1", "8/12/6/2"},
    {"point outside of a cube", kCube, "point(3,3,3)", "9/12/6/2", "0/0/0/1", "8/12/6/2"},
    {"segments cross", "segment(-1,0,0,1,0,0)", "segment(0,-1,0,0,1,0)", "5/4/0/1", "1/0/0/1", "3/2/0/1"},
    {"segments overlap", "segment(0,0,0,2,0,0)", "segment(1,0,0,3,0,0)", "2/1/0/1", "2/1/0/1", "2/1/0/1"},
    {"segments share an end in line", "segment(0,0,0,1,0,0)", "segment(1,0,0,2,0,0)", "2/1/0/1", "1/0/0/1", "2/1/0/1"},
    {"segments share an end at an angle", "segment(0,0,0,1,0,0)", "segment(1,0,0,1,1,0)", "3/2/0/1", "1/0/0/1",
     "2/1/0/1"},
    {"segment ends in segment", "segment(-1,0,0,1,0,0)", "segment(0,0,0,0,1,0)", "4/3/0/1", "1/0/0/1", "3/2/0/1"},
    {"skew segments", "segment(-1,0,0,1,0,0)", "segment(0,-1,1,0,1,1)", "4/2/0/1", "0/0/0/1", "2/1/0/1"},
    {"segment pierces facet", "polygon(0,0,0,3,0,0,0,3,0)", "segment(1,1,-1,1,1,1)", "6/5/1/1", "1/0/0/1", "4/3/1/1"},
    {"segment in facet", "polygon(0,0,0,4,0,0,0,4,0)", "segment(1,1,0,2,1,0)", "3/3/1/1", "2/1/0/1", "5/4/1/1"},
    {"segment on an edge of a facet", "polygon(0,0,0,3,0,0,0,3,0)", "segment(1,0,0,2,0,0)", "3/3/1/1", "2/1/0/1",
     "5/5/1/1"},
    {"segment across a facet", "polygon(0,0,0,4,0,0,4,4,0,0,4,0)", "segment(-1,2,0,5,2,0)", "8/8/1/1", "2/1/0/1",
     "6/7/2/1"},
    {"segment through a cube", kCube, "segment(1,1,-1,1,1,3)", "12/14/6/2", "2/1/0/1", "10/13/6/2"},
    {"segment along an edge of a cube", kCube, "segment(0,0,0,0,0,2)", "8/12/6/2", "2/1/0/1", "8/12/6/2"},
    {"segment on past an edge of a cube", kCube, "segment(0,0,-1,0,0,3)", "10/14/6/2", "2/1/0/1", "8/12/6/2"},
    {"segment in a facet of a cube", kCube, "segment(1/2,1,2,3/2,1,2)", "8/12/6/2", "2/1/0/1", "10/13/6/2"},
    {"facet with a facet, one edge in common", "polygon(0,0,0,1,0,0,1,1,0,0,1,0)", "polygon(1,0,0,2,0,0,2,1,0,1,1,0)",
     "4/4/1/1", "2/1/0/1", "4/4/1/1"},
    {"facets overlap", "polygon(0,0,0,2,0,0,2,2,0,0,2,0)", "polygon(1,1,0,3,1,0,3,3,0,1,3,0)", "8/8/1/1", "4/4/1/1",
     "6/6/1/1"},
    {"facets cross", "polygon(-1,-1,0,1,-1,0,1,1,0,-1,1,0)", "polygon(-1,0,-1,1,0,-1,1,0,1,-1,0,1)", "10/13/4/1",
     "2/1/0/1", "6/7/2/1"},
    {"facet inside facet", "polygon(0,0,0,3,0,0,3,3,0,0,3,0)", "polygon(1,1,0,2,1,0,2,2,0,1,2,0)", "4/4/1/1", "4/4/1/1",
     "8/8/1/1"},
    {"facets touch in a vertex", "polygon(0,0,0,1,0,0,1,1,0,0,1,0)", "polygon(1,1,0,2,1,0,2,2,0,1,2,0)", "7/8/2/1",
     "1/0/0/1", "4/4/1/1"},
    {"facet cuts a cube", kCube, "polygon(-1,-1,1,3,-1,1,3,3,1,-1,3,1)", "16/24/11/2", "4/4/1/1", "12/20/11/3"},
    {"facet on a cube's facet", kCube, "polygon(0,0,2,2,0,2,2,2,2,0,2,2)", "8/12/6/2", "4/4/1/1", "8/12/6/2"},
    {"facet inside a cube", kCube, "polygon(1/2,1/2,1,1,1/2,1,1/2,1,1)", "8/12/6/2", "3/3/1/1", "11/15/7/2"},
    {"cube apart from cube", kCube, "box(3,0,0,4,1,1)", "16/24/12/3", "0/0/0/1", "8/12/6/2"},
    {"cubes touch in a vertex", kCube, "box(2,2,2,3,3,3)", "15/24/12/3", "1/0/0/1", "8/12/6/2"},
    {"cubes share an edge", kCube, "box(2,2,0,4,4,2)", "14/23/12/3", "2/1/0/1", "8/12/6/2"},
    {"cubes share a facet", kCube, "box(2,0,0,4,2,2)", "8/12/6/2", "4/4/1/1", "8/12/6/2"},
    {"small facet on large facet", kCube, "box(1/2,1/2,2,3/2,3/2,3)", "16/24/11/2", "4/4/1/1", "12/16/7/2"},
    {"cube inside cube", "box(0,0,0,3,3,3)", "box(1,1,1,2,2,2)", "8/12/6/2", "8/12/6/2", "16/24/12/3"},
    {"cubes overlap at a corner", kCube, "box(1,1,1,3,3,3)", "20/30/12/2", "8/12/6/2", "14/21/9/2"},
};

}  // namespace

TEST_CASE("pairs of all dimensions") {
  for (const LiteralCase& c : kCases) {
    INFO(c.what << ": A = " << c.a << ", B = " << c.b);
    const Polyhedron a = set(c.a);
    const Polyhedron b = set(c.b);
    const Polyhedron united = valid(unite(a, b), "A + B");
    const Polyhedron common = valid(intersect(a, b), "A * B");
    const Polyhedron difference = valid(subtract(a, b), "A - B");
    CHECK(count_text(united) == c.united);
    CHECK(count_text(common) == c.common);
    CHECK(count_text(difference) == c.difference);
    // Every other way to ask must agree.
    CHECK(equal(unite(b, a), united));
    CHECK(equal(intersect(b, a), common));
    CHECK(equal(unite(difference, common), a));
    CHECK(equal(complement(intersect(complement(a), complement(b))), united));
    CHECK(equal(symmetric_difference(united, common), symmetric_difference(a, b)));
  }
}

// Found by the laws; each was a bug once.
TEST_CASE("a walk between components of a sphere map that ends along an arc") {
  CHECK(count_text(set("hull(0,0,0,1,0,1,1,0,0,1,1,1) + segment(0,0,0,0,1,0)")) == "5/7/4/2");
}

TEST_CASE("a half-space whose plane passes through edges of the box") {
  const Polyhedron a = set("halfspace(-1,-1,0,0)");
  CHECK(contains(a, {1, 1, 1}));
  CHECK(contains(a, {-5, 5, 1}));
  CHECK_FALSE(contains(a, {Rational(-1, 3), Rational(-1, 3), 7}));
}

TEST_CASE("single sets") {
  CHECK(count_text(set("nothing")) == "0/0/0/1");
  CHECK(count_text(set("everything")) == "0/0/0/1");
  CHECK(count_text(set("point(1,2,3)")) == "1/0/0/1");
  CHECK(count_text(set("segment(0,0,0,1,2,3)")) == "2/1/0/1");
  CHECK(count_text(set("polygon(0,0,0,1,0,0,0,1,0)")) == "3/3/1/1");
  CHECK(count_text(set("hull(0,0,0,1,0,0,0,1,0,0,0,1)")) == "4/6/4/2");
  CHECK(count_text(set("box(0,0,0,1,2,3)")) == "8/12/6/2");
  CHECK(count_text(set("!box(0,0,0,1,2,3)")) == "8/12/6/2");
  CHECK(count_text(set("boundary(box(0,0,0,1,2,3))")) == "8/12/6/2");
  CHECK(equal(set("box(0,0,0,1,1,0)"), set("polygon(0,0,0,1,0,0,1,1,0,0,1,0)")));
  CHECK(equal(set("box(0,0,0,1,0,0)"), set("segment(0,0,0,1,0,0)")));
  CHECK(equal(set("box(1,1,1,1,1,1)"), set("point(1,1,1)")));
  CHECK(set("everything").is_everything());
  CHECK_FALSE(set("!box(0,0,0,1,1,1)").is_bounded());
  CHECK(set("box(0,0,0,1,1,1)").is_bounded());
  CHECK_FALSE(set("halfspace(1,0,0,0)").is_bounded());
  CHECK_FALSE(volume(set("halfspace(1,0,0,0)")).has_value());
  CHECK(*volume(set("box(0,0,0,1/2,2,3)")) == 3);
  CHECK(*volume(set("hull(0,0,0,1,0,0,0,1,0,0,0,1)")) == Rational(1, 6));
  CHECK(*volume(set("box(0,0,0,3,3,3) - box(1,1,1,2,2,2)")) == 26);
}

TEST_CASE("half-spaces make what they bound") {
  CHECK(equal(set("halfspace(-1,0,0,0) * halfspace(1,0,0,-1) * halfspace(0,-1,0,0) * halfspace(0,1,0,-1) * "
                  "halfspace(0,0,-1,0) * halfspace(0,0,1,-1)"),
              set("box(0,0,0,1,1,1)")));
  CHECK(set("halfspace(1,0,0,0) + halfspace(-1,0,0,0)").is_everything());
  CHECK(equal(set("halfspace(1,0,0,0) * halfspace(-1,0,0,0)"), set("boundary(halfspace(1,0,0,0))")));
  CHECK(set("halfspace(1,0,0,0) * halfspace(-1,0,0,1)").is_empty());
  CHECK(equal(set("!halfspace(1,0,0,0)"), set("interior(halfspace(-1,0,0,0))")));
  CHECK(equal(set("box(0,0,0,2,2,2) * halfspace(1,0,0,-1)"), set("box(0,0,0,1,2,2)")));
  // A line, as two planes meet; a point, as three do.
  const char* axis = "boundary(halfspace(1,0,0,0)) * boundary(halfspace(0,1,0,0))";
  // Where the line meets the infimaximal box, the wall around it is a sloop: no boundary of the set.
  for (const char* operation : {"closure(", "boundary("}) {
    const Polyhedron line = set(operation + std::string(axis) + ")");
    CHECK(validate(line.complex()).empty());
    CHECK(equal(line, set(axis)));
  }
  CHECK(set("interior(" + std::string(axis) + ")").is_empty());
  CHECK(contains(set(axis), {0, 0, 1000000}));
  CHECK_FALSE(contains(set(axis), {0, 1, 1000000}));
  CHECK(equal(set(std::string(axis) + " * boundary(halfspace(0,0,1,-7))"), set("point(0,0,7)")));
  CHECK(equal(set(std::string(axis) + " * box(-1,-1,-1,1,1,1)"), set("segment(0,0,-1,0,0,1)")));
}

}  // namespace nef::test
