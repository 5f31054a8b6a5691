// SPDX-License-Identifier: Apache-2.0
//
// The bounds of filters against rational arithmetic, where they are worst: hill climbing over the bits of coordinates
// looks for the largest error as a part of its bound. No part exceeds 1, and the search gets so near that a bound with
// far more room than its derivation says would be seen, too.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "nef/geometry/direction_error.h"
#include "nef/geometry/predicates.h"
#include "tests/support/numbers/magnitudes.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::test {
namespace {

// What the doubles of a plane are scaled by.
Rational scale_of(const PlaneTable& planes, PlaneId plane) {
  std::size_t top = 0;
  for (std::size_t i = 0; i < 3; ++i) top = std::max(top, mpz_sizeinbase(planes.coefficient(plane, i), 2));
  return power_of_two(-static_cast<long>(top));
}

Rational coefficient(const PlaneTable& planes, PlaneId plane, std::size_t i) {
  Integer value;
  mpz_set(value.get_mpz_t(), planes.coefficient(plane, i));
  return Rational(value);
}

}  // namespace

TEST_CASE("the form of a plane at a point: the bound holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {50U, 54U, 60U, 62U}) {
    const double found = worst(bits, 8, bits, [](const Genes& g) {
      PlaneTable planes;
      PointTable points;
      const PlaneId plane = planes.intern(g[0], g[1], g[2], g[3]);
      const Rational3 at{Rational(g[4]) / g[7], Rational(g[5]) / g[7], Rational(g[6]) / g[7]};
      const PointId point = points.push(at);
      const Approximation form = approximate_form(planes.approximate(plane), points.approximate(point));
      Rational truth = coefficient(planes, plane, 3);
      for (std::size_t i = 0; i < 3; ++i) truth += coefficient(planes, plane, i) * at[i];
      return part_of(exact_rational(form.value) - truth * scale_of(planes, plane), form.error);
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    if (bits >= 60) CHECK(found > 1.0 / 8);
  }
}

TEST_CASE("the difference of two coordinates: the bound holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U, 64U}) {
    const double found = worst(bits, 4, bits, [](const Genes& g) {
      PointTable points;
      const Rational a = Rational(g[0]) / g[1];
      const Rational b = Rational(g[2]) / g[3];
      const PointId p = points.push({a, 0, 0});
      const PointId q = points.push({b, 0, 0});
      const Approximation d = approximate_difference(points.approximate(p)[0], points.approximate(q)[0]);
      return part_of(exact_rational(d.value) - (a - b), d.error);
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 8);
  }
}

TEST_CASE("the cross product of two normals: its error and that of the unit vector hold where they are worst",
          "[bounds]") {
  for (const bool nearly_parallel : {false, true}) {
    double farthest = 0;  // the unit vector, as a part of what boxes around directions allow for one point
    const double found = worst(nearly_parallel ? 7 : 8, 6, 62, [&](const Genes& g) {
      PlaneTable planes;
      const PlaneId p = planes.intern(g[0], g[1], g[2], 1);
      // Nearly parallel: the second normal is the first one, and another one 2^-20 as large.
      const PlaneId q = nearly_parallel
                            ? planes.intern(g[0] + (g[3] >> 19), g[1] + (g[4] >> 19), g[2] + (g[5] >> 19), 1)
                            : planes.intern(g[3], g[4], g[5], 1);
      const Direction d = Direction::cross(planes, p, q);
      const Integer3& t = d.integers();
      if (d.error <= 4 * kRoundingUnit) return 0.0;  // from integers
      CHECK(d.error <= kMostDirectionError);
      const std::array<double, 4>& a = planes.approximate(p);
      const std::array<double, 4>& b = planes.approximate(q);
      double largest = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        largest = std::max(largest, std::fabs(a[j] * b[k] - a[k] * b[j]));
      }
      const Rational scale = scale_of(planes, p) * scale_of(planes, q) / exact_rational(largest);
      double part = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        part = std::max(part, part_of(exact_rational(d.approximate[i]) - t[i] * scale, d.error));
      }
      // Unit vectors, in 256 bits.
      mpf_class found_length(0, 256);
      mpf_class true_length(0, 256);
      for (std::size_t i = 0; i < 3; ++i) {
        found_length += mpf_class(d.approximate[i], 256) * mpf_class(d.approximate[i], 256);
        true_length += mpf_class(t[i], 256) * mpf_class(t[i], 256);
      }
      found_length = sqrt(found_length);
      true_length = sqrt(true_length);
      mpf_class square(0, 256);
      for (std::size_t i = 0; i < 3; ++i) {
        const mpf_class x = mpf_class(d.approximate[i], 256) / found_length - mpf_class(t[i], 256) / true_length;
        square += x * x;
      }
      farthest = std::max(farthest, mpf_class(sqrt(square)).get_d() / (1.7321 * kMostDirectionError));
      return part;
    });
    INFO((nearly_parallel ? "nearly parallel: " : "any: ") << found << ", unit vector " << farthest);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 16);
    CHECK(farthest <= 1);
  }
}

TEST_CASE("signs of dot products and determinants next to zero are the exact ones", "[bounds]") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 3000; ++i) {
    PlaneTable planes;
    const auto gene = [&] { return random_gene(random, 62); };
    const PlaneId p = planes.intern(gene(), gene(), gene(), 1);
    const PlaneId q = planes.intern(gene(), gene(), gene(), 1);
    const Direction along = Direction::cross(planes, p, q);
    const Integer3& t = along.integers();
    // Almost across the direction: rounded to about 60 bits, then moved by a few units of that.
    const Integer x = gene();
    const Integer y = gene();
    const Integer z = -(t[0] * x + t[1] * y) / (t[2] == 0 ? Integer(1) : t[2]) + static_cast<int>(random() % 3) - 1;
    if (x == 0 && y == 0 && z == 0) continue;
    const PlaneId r = planes.intern(x, y, z, 1);
    const Integer dot = t[0] * planes.oriented_coefficient(r, 0) + t[1] * planes.oriented_coefficient(r, 1) +
                        t[2] * planes.oriented_coefficient(r, 2);
    const Direction normal = Direction::normal(planes, r);
    CHECK(sign_of_dot(normal, along, {}) == sgn(dot));
    const int determinant = sign_of_determinant(normal, Direction::normal(planes, p), Direction::normal(planes, q), {});
    CHECK(determinant == sgn(dot));
    const Direction twin = Direction::cross(planes, p,
                                            planes.intern(planes.oriented_coefficient(p, 0) + t[0] / (Integer(1) << 62),
                                                          planes.oriented_coefficient(p, 1) + t[1] / (Integer(1) << 62),
                                                          planes.oriented_coefficient(p, 2) + 1, 1));
    const bool same = same_direction(along, twin, {});
    const Integer3& w = twin.integers();
    const bool truly = t[0] * w[1] == t[1] * w[0] && t[1] * w[2] == t[2] * w[1] && t[0] * w[2] == t[2] * w[0] &&
                       t[0] * w[0] + t[1] * w[1] + t[2] * w[2] > 0;
    CHECK(same == truly);
  }
}

}  // namespace nef::test
