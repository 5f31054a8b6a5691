// SPDX-License-Identifier: Apache-2.0
//
// A set large enough to be linked in shares, on any number of threads, against the one that Booleans have linked.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/construct/construct.h"
#include "nef/location/query_structure.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/measures/approximate_volume.h"
#include "nef/synthesis/complex_builder.h"
#include "nef/validation/validate.h"
#include "tests/support/shapes/oblique_rotation.h"

namespace nef::test {
namespace {

Rational3 lattice_point(std::mt19937& random) {
  Rational3 point;
  for (Rational& x : point) x = static_cast<int>(random() % 8);
  return point;
}

// Boxes and plates with cavities, handles, holes in facets and vertices inside them, in a cell of 12.
Polyhedron cluttered_cell(std::mt19937& random) {
  Polyhedron set;
  for (int i = 0; i < 8; ++i) {
    const Rational3 low = lattice_point(random);
    Rational3 high = low;
    for (Rational& x : high) x += static_cast<int>(random() % 5);
    const Polyhedron box = make_box(low, high);
    set = random() % 3 == 0 ? symmetric_difference(set, box) : unite(set, box);
  }
  const Rational3 point = lattice_point(random);
  return symmetric_difference(set, make_segment(point, {point[0], point[1] + 1, point[2] + 3}));
}

// Cells side by side: many share planes and lines.
Polyhedron many_cells(int along) {
  std::mt19937 random(7);
  std::vector<Polyhedron> cells;
  for (int i = 0; i < along * along * along; ++i) {
    const Rational3 at{12 * (i % along), 12 * (i / along % along), 12 * (i / along / along)};
    cells.push_back(transform(cluttered_cell(random), AffineMap::translate(at)));
  }
  return unite_all(cells);
}

Complex linked_anew(const Complex& c, unsigned threads) {
  PlaneTable planes = c.planes;
  ComplexBuilder builder(planes, Monitor().on_threads(threads));
  builder.copy(c);
  return builder.finish(0);
}

void check_same_facets(const Complex& a, const Complex& b) {
  REQUIRE(a.facet_count() == b.facet_count());
  for (const FacetId f : a.facets.ids()) {
    const Facet& p = a.facets[f];
    const Facet& q = b.facets[f];
    const bool same = p.plane == q.plane && p.mark == q.mark && p.first_cycle == q.first_cycle &&
                      p.cycle_count == q.cycle_count && p.first_isolated == q.first_isolated &&
                      p.isolated_count == q.isolated_count && p.volume_above == q.volume_above &&
                      p.volume_below == q.volume_below;
    REQUIRE(same);
  }
}

TEST_CASE("Links do not depend on the number of threads, item for item", "[threads]") {
  const Polyhedron set = many_cells(7);
  const Complex& c = set.complex();
  REQUIRE(c.shalfedge_count() > 1U << 15U);  // with fewer there are no shares
  REQUIRE(c.svertex_count() > 1U << 15U);
  REQUIRE_FALSE(c.isolated_vertices.empty());
  for (const unsigned threads : {1U, 2U, 5U, 0U}) {
    INFO("threads " << threads);
    const Complex again = linked_anew(c, threads);
    CHECK(validate(again) == "");
    CHECK(again.twin == c.twin);
    check_same_facets(again, c);
    CHECK(again.cycle_begin == c.cycle_begin);
    CHECK(again.corners == c.corners);
    CHECK(again.isolated_vertices == c.isolated_vertices);
    CHECK(again.shalfedge_facet.pairs() == c.shalfedge_facet.pairs());
    CHECK(again.sloop_facet == c.sloop_facet);
    CHECK(again.sface_shell == c.sface_shell);
  }
}

TEST_CASE("A volume in doubles does not depend on the number of threads", "[threads]") {
  const Polyhedron set = many_cells(7);
  REQUIRE(set.complex().facet_count() > 4096);  // of a task
  const MeasuredVolume one = approximate_volume(set);
  const MeasuredVolume three = approximate_volume(set, Monitor().on_threads(3));
  CHECK(one.value == three.value);
  CHECK(one.error == three.error);
  const Rational exact = *volume(set);
  CHECK(abs(exact - exact_rational(one.value)) <= exact_rational(one.error));
}

TEST_CASE("An area in doubles is off by no more than it says, and does not depend on the number of threads",
          "[threads]") {
  const Polyhedron set = many_cells(6);
  // Turned, and far from the origin: no coordinate is a double.
  const AffineMap away = AffineMap::translate({Rational(100001, 3), Rational(200003, 7), Rational(-50, 11)});
  for (const Polyhedron& some : {set, transform(set, away.after(oblique_rotation()))}) {
    const MeasuredArea one = approximate_area(some);
    const MeasuredArea three = approximate_area(some, Monitor().on_threads(3));
    CHECK(one.value == three.value);
    CHECK(one.error == three.error);
    const double area = surface_area(some);  // within some units in the last place
    CHECK(std::fabs(one.value - area) <= one.error + area * 0x1p-49);
    CHECK(one.error < area * 1e-6);
  }
  CHECK(approximate_area({}).value == 0);
}

TEST_CASE("A structure for some rays finds on them what the one for all finds") {
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    const Polyhedron set = cluttered_cell(random);
    const Complex& c = set.complex();
    std::vector<VertexId> asked;
    std::vector<Box> rays;
    for (const VertexId v : c.vertex_ids()) {
      if (random() % 4 != 0) continue;
      asked.push_back(v);
      rays.emplace_back();
      rays.back().add_rounded(c.points.approximate(point_of(v)));
      rays.back().low[0] = -std::numeric_limits<double>::infinity();
    }
    const QueryStructure all(c);
    const QueryStructure some(c, BoxTree(rays));
    for (const VertexId v : asked) {
      const std::optional<ComplexHit> expected = all.first_hit_minus_x(c, v, {});
      const std::optional<ComplexHit> found = some.first_hit_minus_x(c, v, {});
      REQUIRE(found.has_value() == expected.has_value());
      if (!found) continue;
      CHECK(found->kind == expected->kind);
      // Of an edge either half may be told, and what is seen from there.
      const bool edge = found->kind == ComplexHit::Kind::kEdge;
      CHECK((found->index == expected->index || (edge && found->halfedge() == c.twin[expected->halfedge()])));
      if (found->sface.valid()) CHECK(c.sface_shell[found->sface] == c.sface_shell[expected->sface]);
      CHECK(found->sface.valid() == expected->sface.valid());
    }
  }
}

}  // namespace
}  // namespace nef::test
