// SPDX-License-Identifier: Apache-2.0
//
// Sums with known answers: published counts and volumes, closed forms.
#include <catch2/catch.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/io/mesh/mesh_reader.h"
#include "tests/support/literals.h"
#include "tests/support/paths.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/union_orders.h"

namespace {

using nef::Polyhedron;
using nef::Rational;
using nef::Rational3;
using nef::minkowski::ConvexCell;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::UnionStrategy;
using nef::test::set;

Polyhedron data(const std::string& name) {
  return nef::from_mesh(nef::read_mesh(source_folder() + "/data/meshes/" + name + ".off"));
}

TEST_CASE("published sums, exactly, by every strategy") {
  const Polyhedron small_cube = set("box(-1/10,-1/10,-1/10,1/10,1/10,1/10)");
  const Polyhedron unit = set("box(0,0,0,1,1,1)");
  const std::vector<std::tuple<Polyhedron, Polyhedron, std::size_t, std::size_t, Rational>> known = {
      {data("star"), data("star"), 50, 72, Rational(7, 8)},
      {data("star"), small_cube, 32, 30, Rational(681, 2000)},
      {nef::from_mesh(nef::read_mesh(source_folder() + "/data/minkowski/P.off")), unit, 16, 10, Rational(38)},
      {data("cross_quad"), data("star"), 88, 78, Rational(30)}};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto& [a, b, vertices, facets, content] = known[i];
    for (const UnionStrategy strategy : {UnionStrategy::kAuto, UnionStrategy::kConvolution, UnionStrategy::kQueue}) {
      CAPTURE(i, static_cast<int>(strategy));
      MinkowskiOptions options;
      options.strategy = strategy;
      const Polyhedron sum = nef::test::valid(minkowski_sum(a, b, options), "sum");
      CHECK(nef::counts(sum).vertices == vertices);
      CHECK(nef::counts(sum).facets == facets);
      CHECK(nef::counts(sum).volumes == 2);
      CHECK(*nef::volume(sum) == content);
    }
  }
}

// A pyramid over a regular 16-gon of radius 1. The published data is cut to three decimals far from the origin, so
// that coordinates along u on the side `longer` are a thousandth larger; the counts depend on it.
Polyhedron dioctagonal_pyramid(std::size_t u, std::size_t v, int longer, const Rational3& apex) {
  const std::array<Rational, 5> part = {Rational(1), Rational(923, 1000), Rational(707, 1000), Rational(382, 1000),
                                        Rational(0)};
  std::vector<Rational3> points = {apex};
  for (std::size_t k = 0; k < 5; ++k) {
    for (const int su : {-1, 1}) {
      for (const int sv : {-1, 1}) {
        Rational3 p;
        p[u] = su * part[k];
        if (su == longer && k > 0 && k < 4) p[u] += Rational(su, 1000);
        p[v] = sv * part[4 - k];
        points.push_back(p);
      }
    }
  }
  return nef::convex_hull(points);
}

TEST_CASE("the polytopes of Fogel and Halperin: published counts, exact volumes, by every strategy") {
  const Polyhedron tetrahedron = set("hull(-1,-0.73,-0.73, 0,-0.73,1, 0,1,0, 1,-0.73,-0.73)");
  const Polyhedron icosahedron =
      set("hull(1.05,0,0.525, 0.85,0.618,-0.525, 0.85,-0.618,-0.525, 0.325,1,0.525, 0.325,-1,0.525, 0,0,1.175,"
          "-1.05,0,-0.525, -0.85,-0.618,0.525, -0.85,0.618,0.525, -0.325,-1,-0.525, -0.325,1,-0.525, 0,0,-1.175)");
  const Polyhedron pyramid = dioctagonal_pyramid(0, 1, 1, {Rational(0), Rational(0), Rational(-1)});
  const Polyhedron orthogonal = dioctagonal_pyramid(0, 2, -1, {Rational(0), Rational(-1), Rational(0)});
  const std::vector<std::tuple<Polyhedron, Polyhedron, std::string, Rational>> known = {
      {tetrahedron, tetrahedron, "4/6/4/2", Rational(29929, 3750)},
      {set("box(-1,-1,-1,1,1,1)"), tetrahedron, "16/28/14/2", Rational(305629, 7500)},
      {icosahedron, icosahedron, "12/30/20/2", Rational(2467463, 75000)},
      {pyramid, orthogonal, "131/261/132/2", Rational(mpz_class("23392576289"), mpz_class("1500000000"))}};
  for (const auto& [a, b, counts, content] : known) {
    for (const UnionStrategy strategy : {UnionStrategy::kAuto, UnionStrategy::kConvolution, UnionStrategy::kQueue}) {
      MinkowskiOptions options;
      options.strategy = strategy;
      const Polyhedron sum = nef::test::valid(minkowski_sum(a, b, options), "sum");
      CHECK(nef::test::count_text(sum) == counts);
      CHECK(*nef::volume(sum) == content);
    }
  }
}

TEST_CASE("a fine ball, whose sums are few and large, united in every order") {
  const Polyhedron corner = set("box(0,0,0,3,1,1) + box(0,0,0,1,3,1)");
  const Polyhedron ball =
      to_polyhedron(nef::minkowski::ball_approximation(Rational(1, 3), 9, nef::minkowski::Side::kInner).cell);
  const Polyhedron sum = nef::test::valid(minkowski_sum(corner, ball), "sum");
  const std::vector<Polyhedron> sums = nef::test::sums_of_cells(corner, ball);
  for (const auto& [name, order] : nef::test::kUnionOrders) CHECK(nef::equal(united(sums, order), sum));
}

TEST_CASE("two boxes, a prism and its mirror image") {
  CHECK(nef::equal(minkowski_sum(set("box(1,2,3,4,5,6)"), set("box(-1,0,0,1,2,5)")), set("box(0,2,3,5,7,11)")));
  // A triangle plus its mirror image is a hexagon of six times the area.
  const Polyhedron prism = set("hull(0,0,0, 3,0,0, 0,3,0, 0,0,1, 3,0,1, 0,3,1)");
  const Polyhedron sum = minkowski_sum(prism, nef::minkowski::negate(prism));
  CHECK(nef::test::count_text(sum) == "12/18/8/2");
  CHECK(*nef::volume(sum) == *nef::volume(prism) * 6 * 2);
}

// Twice the area of the shadow of a cell along an axis.
Rational double_shadow(const ConvexCell& cell, std::size_t axis) {
  std::vector<Rational3> flat = cell.mesh.vertices;
  for (Rational3& p : flat) p[axis] = 0;
  Rational3 normal;
  normal[axis] = 1;
  Rational area;
  const std::vector<std::uint32_t> ring = nef::detail::planar_hull(flat, normal);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    area += nef::cross(flat[ring[k]], flat[ring[(k + 1) % ring.size()]])[axis];
  }
  return area;
}

TEST_CASE("Steiner's formula for a box and a polygonal ball, exactly") {
  const Rational3 side = {Rational(3), Rational(5, 2), Rational(7, 3)};
  for (const int splits : {1, 2, 3}) {
    const ConvexCell ball =
        nef::minkowski::ball_approximation(Rational(2, 3), splits, nef::minkowski::Side::kInner).cell;
    CHECK(ball.mesh.vertices.size() == static_cast<std::size_t>(4 * splits * splits + 2));
    const Polyhedron sum =
        minkowski_sum(nef::make_box({Rational(0), Rational(0), Rational(0)}, side), to_polyhedron(ball));
    // Box, slabs on its faces (the ball's width is 4/3 along each axis), shadows along its edges, the ball.
    Rational expected = side[0] * side[1] * side[2] + *nef::volume(to_polyhedron(ball));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      expected += side[(axis + 1) % 3] * side[(axis + 2) % 3] * Rational(4, 3);
      expected += side[axis] * double_shadow(ball, axis) / 2;
    }
    CHECK(*nef::volume(sum) == expected);
  }
}

TEST_CASE("two geodesic spheres of 252 vertices: convex, and as many facets as the overlay has vertices") {
  const Polyhedron a = nef::from_mesh(nef::test::geodesic_sphere(5, 1, 0));
  const Polyhedron b = nef::from_mesh(nef::test::geodesic_sphere(5, 0.75, 0.3));
  CHECK(nef::counts(a).vertices == 252);
  nef::minkowski::MinkowskiReport report;
  const Polyhedron sum = minkowski_sum(a, b, {}, &report);
  CHECK(report.cells_a == 1);
  CHECK(report.cells_b == 1);
  std::vector<Rational3> points;
  for (std::uint32_t i = 0; i < 252; i += 3) {
    for (std::uint32_t j = 0; j < 252; j += 3) {
      const Rational3 p = a.complex().points.rational(nef::PointId{i});
      const Rational3 q = b.complex().points.rational(nef::PointId{j});
      points.push_back({Rational(p[0] + q[0]), Rational(p[1] + q[1]), Rational(p[2] + q[2])});
    }
  }
  CHECK(nef::subtract(nef::convex_hull(points), sum).is_empty());
  CHECK(nef::counts(sum).volumes == 2);
}

TEST_CASE("a mushroom plus a box: every sum of vertices is in it, and its shadow is the shadow's sum") {
  const Polyhedron a = nef::from_mesh(nef::test::mushroom());
  const Polyhedron b = set("box(-1/10,-1/10,-1/10,1/10,1/10,1/10)");
  nef::minkowski::MinkowskiReport report;
  const Polyhedron sum = nef::test::valid(minkowski_sum(a, b, {}, &report), "sum");
  CHECK(report.cells_a == 0);  // no cells are the fastest way here
  CHECK(report.convolution_facets > a.complex().facet_count());
  MinkowskiOptions options;
  options.strategy = UnionStrategy::kQueue;
  report = {};
  CHECK(nef::equal(minkowski_sum(a, b, options, &report), sum));
  CHECK(report.cells_b == 1);
  CHECK(report.pairs == report.cells_a);
  CHECK(sum.is_closed());
  CHECK(sum.is_regular());
  const auto box_a = *nef::bounding_box(a);
  const auto box_sum = *nef::bounding_box(sum);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(box_sum[0][i] == box_a[0][i] - Rational(1, 10));
    CHECK(box_sum[1][i] == box_a[1][i] + Rational(1, 10));
  }
  for (std::uint32_t v = 0; v < a.complex().vertex_count(); v += 5) {
    Rational3 p = a.complex().points.rational(nef::PointId{v});
    for (Rational& x : p) x += Rational(1, 10);
    CHECK(nef::contains(sum, p));
  }
}

}  // namespace
