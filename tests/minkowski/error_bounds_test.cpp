// SPDX-License-Identifier: Apache-2.0
//
// Bounds of rounding errors of sums against rational arithmetic, where they are worst.
#include <catch2/catch.hpp>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/cells/segment.h"
#include "apps/minkowski/convolution/arrangement/facet_segments.h"
#include "apps/minkowski/union/face_chord.h"
#include "apps/minkowski/union/face_remains.h"
#include "tests/support/numbers/next_to_zero.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::minkowski::error_bounds_test {
namespace {

using nef::test::Genes;
using nef::test::part_of;
using nef::test::point_of_genes;
using nef::test::worst;

Double3 rounded(const Rational3& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }

double largest_of(std::initializer_list<Double3> points) {
  double result = 0;
  for (const Double3& p : points) {
    for (const double x : p) result = std::max(result, std::fabs(x));
  }
  return result;
}

TEST_CASE("planes of faces: slack and weight hold where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const double found = worst(bits, 13, bits, [](const Genes& g) {
      std::array<Rational3, 4> p;
      std::array<Double3, 4> x;
      for (std::size_t i = 0; i < 4; ++i) {
        p[i] = point_of_genes(g, 3 * i, 12);
        x[i] = rounded(p[i]);
      }
      const RoundedFace face = rounded_plane(x[0], x[1], x[2], largest_of({x[0], x[1], x[2], x[3]}));
      const Rational truth = dot(cross(minus(p[1], p[0]), minus(p[2], p[1])), minus(p[3], p[0]));
      return part_of(exact_rational(face.value(x[3])) - truth, face.slack);
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 128);
  }
}

// The point where a line reaches a bound, of slopes and values that doubles hold exactly.
TEST_CASE("segments: parameters are kept on the safe side by more than is rounded", "[bounds]") {
  const double found = worst(5, 3, 53, [](const Genes& g) {
    const double at = nearest_double(Rational(g[0]));
    const double bound = nearest_double(Rational(g[1]));
    const double slope = nearest_double(Rational(g[2]));
    const Rational truth = (Rational(g[1]) - g[0]) / g[2];
    if (slope < 0 || truth < -1 || truth > 2) return 0.0;
    Interval t{-2, 3};
    keep_below(t, at, slope, bound, Rounding::kInwards);
    return part_of(exact_rational(t.high + 1e-13) - truth, 1e-13);
  });
  INFO(found);
  CHECK(found <= 1);
}

// Two chords of one line, whose ends are moved by up to their errors: where the second one lies on the first.
TEST_CASE("chords: what they have in common is enclosed where the error is worst", "[bounds]") {
  const double found = worst(7, 12, 53, [](const Genes& g) {
    const double scale = 0x1p-53;
    const Rational3 from = point_of_genes(g, 0, 9);
    const Rational3 to = point_of_genes(g, 3, 9);
    const Rational3 along = minus(to, from);
    std::array<Rational, 2> t{abs(Rational(g[10])) * exact_rational(scale),
                              abs(Rational(g[11])) * exact_rational(scale)};
    if (t[0] > t[1]) std::swap(t[0], t[1]);
    const double error = 0x1p-30 * largest_of({rounded(from), rounded(to)});
    std::size_t bit = 0;
    // Each coordinate off by the error, one way or the other as the bits of a gene say.
    const auto moved = [&](const Rational3& p) {
      Double3 x = rounded(p);
      for (double& value : x)
        value += (mpz_tstbit(g[6 + bit % 3].get_mpz_t(), bit) != 0 ? 0.999 : -0.999) * error, ++bit;
      return x;
    };
    const auto at = [&](const Rational& s) {
      return Rational3{from[0] + s * along[0], from[1] + s * along[1], from[2] + s * along[2]};
    };
    const Chord a{{moved(from), moved(to)}, error};
    const Chord b{{moved(at(t[0])), moved(at(t[1]))}, error};
    const Interval common = overlap(a, b);
    if (common.low <= 0 || common.high >= 1) return 0.0;
    // How far the true ends are from the middle of the interval, as a part of its half.
    const Rational middle = (exact_rational(common.low) + exact_rational(common.high)) / 2;
    const double half = (common.high - common.low) / 2;
    return std::max(part_of(t[0] - middle, half), part_of(t[1] - middle, half));
  });
  INFO(found);
  CHECK(found <= 1);
  CHECK(found > 0.5);
}

using Triangle = std::array<Rational3, 3>;

Rational3 normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

// Triangles as facets of a convolution.
ConvolutionFacets facets_of(std::span<const Triangle> triangles) {
  ConvolutionFacets facets;
  for (const Triangle& t : triangles) {
    for (const Rational3& p : t) {
      facets.corners.push_back(facets.points.push(p).index());
      facets.rounded.push_back(rounded(p));
    }
    const Rational3 normal = normal_of(t);
    Integer common = 1;
    for (const Rational& x : normal) common = lcm(common, x.get_den());
    Integer3 n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = Rational(normal[i] * common).get_num();
    facets.plane.push_back(plane_through(facets.planes, facets.points, n, PointId{facets.corners.end()[-3]}));
    facets.begin.push_back(static_cast<std::uint32_t>(facets.corners.size()));
  }
  return facets;
}

Triangle triangle_of(const Genes& g, std::size_t first, std::size_t below) {
  return {point_of_genes(g, first, below), point_of_genes(g, first + 3, below), point_of_genes(g, first + 6, below)};
}

bool is_flat(const Triangle& t) { return normal_of(t) == Rational3{}; }

TEST_CASE("sides of convolution facets: slack holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const double found = worst(bits, 13, bits, [](const Genes& g) {
      const Triangle t = triangle_of(g, 0, 12);
      if (is_flat(t)) return 0.0;
      const ConvolutionFacets facets = facets_of({&t, 1});
      const RoundedFacets around(facets, {});
      const Double3 x = rounded(point_of_genes(g, 9, 12));
      if (largest_of({x}) > around.extent()) return 0.0;
      double result = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const RoundedSide& side = around.sides(0)[i];
        const Rational3 along = minus(t[(i + 1) % 3], t[i]);
        const Rational truth = along[side.u] * (exact_rational(x[side.v]) - t[i][side.v]) -
                               along[side.v] * (exact_rational(x[side.u]) - t[i][side.u]);
        const Rational value = exact_rational(side.value(x));
        // Which way the facet turns in its projection, the third corner says.
        const Rational3 third = minus(t[(i + 2) % 3], t[i]);
        const bool turned = along[side.u] * third[side.v] < along[side.v] * third[side.u];
        result = std::max(result, part_of(turned ? Rational(value + truth) : Rational(value - truth), side.slack));
      }
      return result;
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 128);
  }
}

// Where a side of a triangle meets the plane of another one.
Rational3 crossing(const Rational3& p, const Rational3& q, const Triangle& other) {
  const Rational3 normal = normal_of(other);
  const Rational at = dot(normal, minus(p, other[0]));
  const Rational there = dot(normal, minus(q, other[0]));
  return nef::test::along(p, minus(q, p), at / (at - there));
}

TEST_CASE("segments of convolution facets: ends are within their error where it is worst", "[bounds]") {
  std::size_t crossings = 0;
  for (const unsigned bits : {54U, 62U}) {
    const auto part = [&](const Genes& g) {
      const std::array<Triangle, 2> t = {triangle_of(g, 0, 18), triangle_of(g, 9, 18)};
      if (is_flat(t[0]) || is_flat(t[1])) return 0.0;
      const ConvolutionFacets facets = facets_of(t);
      const RoundedFacets around(facets, {});
      const std::optional<FacetSegment> s = SegmentFinder(facets, around, {}).find(0, 1);
      if (!s) return 0.0;
      double result = 0;
      for (const std::size_t k : {0U, 1U}) {
        const SegmentEnd& end = s->ends[k];
        if (end.kind != SegmentEnd::Kind::kSide) continue;
        ++crossings;
        const Triangle& its = t[end.facet];
        const Rational3 truth = crossing(its[end.index], its[(end.index + 1) % 3], t[1 - end.facet]);
        const Double3& x = k == 0 ? s->from : s->to;
        for (std::size_t i = 0; i < 3; ++i) {
          result = std::max(result, part_of(exact_rational(x[i]) - truth[i], s->error));
        }
      }
      return result;
    };
    const double found = worst(bits, 19, bits, part);
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 256);
  }
  CHECK(crossings > 1000);
}

// A triangle in a tetrahedron, its corners in three of the facets, or beside them by next to nothing: a corner that is
// not inside stays, and so does what else of its sides is not.
TEST_CASE("face remains: what is next to the boundary of another cell is left", "[bounds]") {
  nef::test::NextToZero random(23);
  std::size_t gone = 0;
  std::size_t left = 0;
  for (int round = 0; round < 2000; ++round) {
    const nef::test::TwoTetrahedra tetrahedra = nef::test::vertex_on_facet(random);
    const std::array<Rational3, 4>& outer = tetrahedra.first;
    Rational3 middle{};
    for (const Rational3& p : outer) middle = nef::test::along(middle, p, Rational(1, 4));
    Triangle inner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational s = random.share();
      const Rational t = random.share() * (1 - s);
      const Rational3& o = outer[i];
      const Rational3 on =
          nef::test::along(nef::test::along(o, minus(outer[(i + 1) % 4], o), s), minus(outer[(i + 2) % 4], o), t);
      const Rational shift = random.below(3) == 0 ? Rational(-1, 8) : random.tiny();
      inner[i] = nef::test::along(on, minus(on, middle), shift);
    }
    const Rational3 centre = nef::test::along(middle, minus(outer[1], middle), Rational(1, 5));
    const std::array<Rational3, 4> second = {inner[0], inner[1], inner[2], centre};
    const std::vector<ConvexCell> cells = {hull_cell(outer), hull_cell(second)};
    if (is_flat(inner) || cells[0].dimension != 3 || cells[1].dimension != 3) continue;
    const RoundedCells around(cells);
    if (!has_moderate_size(around.extent())) continue;
    const ExactCells exact(cells, around, {});
    const PlanesOfCells planes(around, exact);
    const FlushFaces flush(cells, around, exact, planes);
    const BoxTree boxes(around.boxes());
    FaceRemains remains(around, flush, boxes);
    const auto is_inside = [&](const Rational3& x) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Triangle facet = {outer[i], outer[(i + 1) % 4], outer[(i + 2) % 4]};
        const Rational3 normal = normal_of(facet);
        const Rational opposite = dot(normal, minus(outer[(i + 3) % 4], facet[0]));
        if (sgn(dot(normal, minus(x, facet[0]))) * sgn(opposite) <= 0) return false;
      }
      return true;
    };
    std::vector<Double3> ring;
    for (const Rational3& p : inner) ring.push_back(rounded(p));
    for (std::uint32_t f = around.first_face(1); f < around.end_face(1); ++f) {
      // The face of the three corners: the one whose plane is not off any of them by more than is rounded.
      const RoundedFace& face = around.face(f);
      if (std::any_of(ring.begin(), ring.end(),
                      [&](const Double3& x) { return std::fabs(face.value(x)) > face.slack; }))
        continue;
      const Box rest = remains.box_of_rest(f, ring);
      bool all_inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        for (const Rational& t : {Rational(0), Rational(random.share())}) {
          const Rational3 x = nef::test::along(inner[i], minus(inner[(i + 1) % 3], inner[i]), t);
          if (is_inside(x)) continue;
          all_inside = false;
          for (std::size_t k = 0; k < 3; ++k) {
            REQUIRE(rest.low[k] <= rest.high[k]);
            CHECK((exact_rational(rest.low[k]) <= x[k] && x[k] <= exact_rational(rest.high[k])));
          }
        }
      }
      ++(rest.low[0] > rest.high[0] ? gone : left);
      if (!all_inside) continue;
      break;
    }
  }
  CHECK(gone > 20);
  CHECK(left > 500);
}

}  // namespace
}  // namespace nef::minkowski::error_bounds_test
