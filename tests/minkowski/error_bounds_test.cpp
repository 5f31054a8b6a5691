// SPDX-License-Identifier: Apache-2.0
//
// Bounds of rounding errors of sums against rational arithmetic, where they are worst.
#include <catch2/catch.hpp>

#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/cells/segment.h"
#include "apps/minkowski/union/face_chord.h"
#include "tests/support/worst_error.h"

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

}  // namespace
}  // namespace nef::minkowski::error_bounds_test
