// SPDX-License-Identifier: Apache-2.0
//
// Sections: membership from the recipe, polygons against parity by arithmetic of their own, areas by counting cells.
#include "nef/parts/section.h"

#include "nef/base/error.h"
#include "tests/laws/laws.h"

namespace nef {
namespace {

using test::set;

// Twice the signed area of a ring, as seen from the side that the axis points to.
Rational twice_area(const std::vector<Rational3>& ring, std::size_t axis) {
  const std::size_t k = (axis + 1) % 3;
  const std::size_t m = (axis + 2) % 3;
  Rational sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Rational3& u = ring[i];
    const Rational3& v = ring[(i + 1) % ring.size()];
    sum += u[k] * v[m] - u[m] * v[k];
  }
  return sum;
}

// Whether a point (on no ring) of a plane across `axis` lies in the polygon, by counting crossings.
bool inside(const SectionPolygon& polygon, const Rational3& p, std::size_t axis) {
  const std::size_t k = (axis + 1) % 3;
  const std::size_t m = (axis + 2) % 3;
  bool in = false;
  const auto count = [&](const std::vector<Rational3>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Rational3& u = ring[i];
      const Rational3& v = ring[(i + 1) % ring.size()];
      if ((u[k] > p[k]) == (v[k] > p[k])) continue;
      if (u[m] + (p[k] - u[k]) / (v[k] - u[k]) * (v[m] - u[m]) > p[m]) in = !in;
    }
  };
  count(polygon.outer);
  for (const std::vector<Rational3>& hole : polygon.holes) count(hole);
  return in;
}

}  // namespace

TEST_CASE("a section has the points of the set in the plane, and its polygons have their area") {
  CHECK(rc::check("section", [] {
    const test::Recipe recipe = *test::recipes(true, 4);
    const auto axis = *rc::gen::inRange<std::size_t>(0, 3);
    const Rational height = Rational(*rc::gen::inRange(0, 7)) / 2;
    const Polyhedron whole = recipe.make();
    Rational3 normal;
    const int towards = *rc::gen::element(1, -2);
    normal[axis] = towards;
    const Section cut = section(whole, normal, -height * towards);
    RC_ASSERT(validate(cut.set.complex()).empty());
    for (int i = 0; i < 20; ++i) {
      Rational3 p = *test::adversarial_points();
      p[axis] = height;
      RC_ASSERT(contains(cut.set, p) == recipe.contains(p));
      // Off the planes and edges of anything that a recipe can make: coordinates with a large prime denominator.
      Rational3 q;
      for (std::size_t k = 0; k < 3; ++k) q[k] = Rational(*rc::gen::inRange(-1009, 5 * 1009)) / 1009;
      q[axis] = height;
      bool in = false;
      for (const SectionPolygon& polygon : cut.polygons) in = in != inside(polygon, q, axis);
      if (!contains(boundary(cut.set), q)) RC_ASSERT(in == recipe.contains(q));
    }
    for (const SectionPolygon& polygon : cut.polygons) {
      RC_ASSERT(twice_area(polygon.outer, axis) * towards > 0);
      for (const std::vector<Rational3>& hole : polygon.holes) RC_ASSERT(twice_area(hole, axis) * towards < 0);
    }
    RC_ASSERT(cut.unbounded == 0U);
  }));
}

TEST_CASE("polygons, holes, segments and points of a section") {
  const Polyhedron frame = set("box(0,0,0,9,9,9) - box(3,3,-1,6,6,10)");
  const Section ring = section(frame, {0, 0, 1}, -4);
  REQUIRE(ring.polygons.size() == 1);
  CHECK(ring.polygons[0].outer.size() == 4);
  REQUIRE(ring.polygons[0].holes.size() == 1);
  CHECK(twice_area(ring.polygons[0].outer, 2) == 162);
  CHECK(twice_area(ring.polygons[0].holes[0], 2) == -18);
  CHECK(equal(ring.set, set("box(0,0,4,9,9,4) - box(3,3,4,6,6,4)")));
  CHECK_FALSE(contains(ring.set, {3, 4, 4}));
  CHECK(contains(ring.set, {2, 4, 4}));

  // A tetrahedron at its base, through the middle, at its tip and above.
  const Polyhedron tetrahedron = set("hull(0,0,0, 4,0,0, 0,4,0, 0,0,4)");
  CHECK(twice_area(section(tetrahedron, {0, 0, 3}, 0).polygons.at(0).outer, 2) == 16);
  CHECK(twice_area(section(tetrahedron, {0, 0, 1}, -2).polygons.at(0).outer, 2) == 4);
  CHECK(section(tetrahedron, {0, 0, 1}, -4).points == std::vector<Rational3>{{0, 0, 4}});
  CHECK(section(tetrahedron, {0, 0, 1}, -5).set.is_empty());
  // An edge in the plane, and a plane that is no axis plane.
  const Section edge = section(tetrahedron, {1, 0, 1}, 0);
  REQUIRE(edge.segments.size() == 1);
  CHECK(edge.segments[0] == std::array<Rational3, 2>{Rational3{0, 0, 0}, Rational3{0, 4, 0}});
  const Section oblique = section(tetrahedron, {1, 1, 1}, Rational(-2));
  REQUIRE(oblique.polygons.size() == 1);
  CHECK(oblique.polygons[0].outer.size() == 3);

  // Slits do not part a polygon, nor do missing points; the set still lacks them.
  const Section slit = section(set("box(0,0,0,4,4,4) - segment(1,1,2,3,3,2) - point(1,2,2)"), {0, 0, 1}, -2);
  REQUIRE(slit.polygons.size() == 1);
  CHECK(slit.polygons[0].holes.empty());
  CHECK_FALSE(contains(slit.set, {2, 2, 2}));
  CHECK_FALSE(contains(slit.set, {1, 2, 2}));
  // An open cube has no points in the planes of its facets.
  CHECK(section(set("interior(box(0,0,0,1,1,1))"), {0, 0, 1}, 0).set.is_empty());
  // Mixed: a wire through a plate's plane is a point beside it, one within it a segment.
  const Section mixed = section(set("box(0,0,0,1,1,1) + segment(3,0,-1,3,0,1) + segment(5,0,0,6,0,0)"), {0, 0, 1}, 0);
  CHECK(mixed.polygons.size() == 1);
  CHECK(mixed.points == std::vector<Rational3>{{3, 0, 0}});
  CHECK(mixed.segments.size() == 1);
}

TEST_CASE("sections of unbounded sets") {
  const Section half = section(set("halfspace(1,0,0,0)"), {0, 0, 1}, 0);
  CHECK(half.unbounded == 1);
  CHECK(half.polygons.empty());
  CHECK(contains(half.set, {-5, 3, 0}));
  CHECK_FALSE(contains(half.set, {-5, 3, 1}));
  CHECK(section(set("halfspace(0,0,1,0)"), {0, 0, 1}, 1).unbounded == 1);  // a whole plane
  CHECK(section(set("halfspace(0,0,1,0)"), {0, 0, 1}, -1).set.is_empty());
  // A wedge of half-spaces cut to a triangle; a line that a plane meets in a point, and one within it.
  const Section triangle =
      section(set("halfspace(-1,0,0,0) * halfspace(0,-1,0,0) * halfspace(1,1,0,-1)"), {0, 0, 1}, -7);
  CHECK(triangle.unbounded == 0);
  CHECK(twice_area(triangle.polygons.at(0).outer, 2) == 1);
  const Polyhedron line = set("boundary(halfspace(1,0,0,-2)) * boundary(halfspace(0,1,0,-3))");
  CHECK(section(line, {0, 0, 1}, 0).points == std::vector<Rational3>{{2, 3, 0}});
  CHECK(section(line, {1, 0, 0}, -2).unbounded == 1);
  CHECK(section(Polyhedron(), {1, 0, 0}, 0).set.is_empty());
  CHECK_THROWS_AS(section(line, {0, 0, 0}, 1), InputError);
}

}  // namespace nef
