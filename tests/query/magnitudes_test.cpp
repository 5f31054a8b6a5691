// SPDX-License-Identifier: Apache-2.0
//
// Questions about sets at sizes where products of doubles overflow or vanish, against the same at an ordinary size.
#include "tests/support/numbers/magnitudes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/distance/distance.h"
#include "nef/distance/intersects.h"
#include "nef/query/locate_many.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/support/literals.h"

namespace nef::test {
namespace {

Polyhedron oblique(const std::string& text, const Rational3& axis, double degrees) {
  return transform(set(text), AffineMap::rotate(axis, degrees));
}

// Two notched solids, apart by less than a thousandth of their size.
Polyhedron one() { return oblique("box(0,0,0,2,2,2) - box(1,1,-1,3,3,3)", {1, 2, 4}, 20); }
Polyhedron other() {
  const Polyhedron solid = oblique("box(0,0,0,1,3,1) - box(1/3,1,-1,2/3,2,3)", {4, 1, 2}, 70);
  return transform(solid, AffineMap::translate({exact_rational(2.345), exact_rational(0.7), exact_rational(-0.3)}));
}

Rational3 random_point(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> any(-size, size);
  return {exact_rational(any(random)), exact_rational(any(random)), exact_rational(any(random))};
}

}  // namespace

TEST_CASE("queries at any magnitude: distances and common points", "[bounds]") {
  const Polyhedron a = one();
  const Polyhedron b = other();
  const Distance expected = *distance(a, b);
  std::mt19937_64 random(3);
  std::vector<Rational3> translations;
  std::vector<bool> meet;
  for (int i = 0; i < 20; ++i) {
    translations.push_back(random_point(random, 2.5));
    meet.push_back(intersects(a, b, translations.back()));
  }
  CHECK(std::count(meet.begin(), meet.end(), true) > 3);
  CHECK(std::count(meet.begin(), meet.end(), false) > 3);
  for (const long exponent : kExponents) {
    INFO("times 2^" << exponent);
    const Rational factor = power_of_two(exponent);
    const Polyhedron large_a = scaled(a, factor);
    const Polyhedron large_b = scaled(b, factor);
    const Distance found = *distance(large_a, large_b);
    CHECK(found.contact == expected.contact);
    CHECK(found.squared == expected.squared * factor * factor);
    CHECK(found.on_a == scaled(expected.on_a, factor));
    CHECK(found.on_b == scaled(expected.on_b, factor));
    const IntersectionQuery query(large_a, large_b);
    for (std::size_t i = 0; i < meet.size(); ++i) {
      CHECK(query.meet(scaled(translations[i], factor)) == meet[i]);
      CHECK(intersects(large_a, large_b, scaled(translations[i], factor)) == meet[i]);
    }
  }
}

TEST_CASE("queries at any magnitude: places of points, and rays", "[bounds]") {
  const Polyhedron a = unite(one(), other());
  std::mt19937_64 random(5);
  std::vector<Rational3> points;
  std::vector<Rational3> directions;
  for (int i = 0; i < 150; ++i) points.push_back(random_point(random, 3.5));
  for (int i = 0; i < 150; ++i) directions.push_back(random_point(random, 1));
  for (const long exponent : kExponents) {
    INFO("times 2^" << exponent);
    const Rational factor = power_of_two(exponent);
    const Polyhedron large = scaled(a, factor);
    std::vector<std::array<double, 3>> doubles;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rational3 p = scaled(points[i], factor);
      CHECK(contains(large, p) == contains(a, points[i]));
      const std::optional<RayHit> expected = shoot_ray(a, points[i], directions[i]);
      const std::optional<RayHit> hit = shoot_ray(large, p, directions[i]);
      REQUIRE(hit.has_value() == expected.has_value());
      if (hit) CHECK(hit->point == scaled(expected->point, factor));
      doubles.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
    }
    if (exponent > 1000 || exponent < -1060) continue;  // not all are doubles, or next to nothing of them
    const std::vector<LabelId> marks = locate_many(large, doubles);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rational3 p{exact_rational(doubles[i][0]), exact_rational(doubles[i][1]), exact_rational(doubles[i][2])};
      CHECK((marks[i] != 0) == contains(large, p));
    }
  }
}

TEST_CASE("queries at any magnitude: enclosures of volumes", "[bounds]") {
  const Polyhedron a = unite(one(), other());
  const Rational truth = *volume(a);
  for (const long exponent : kExponents) {
    INFO("times 2^" << exponent);
    const Rational factor = power_of_two(exponent);
    const MeasuredVolume found = approximate_volume(scaled(a, factor));
    if (!std::isfinite(found.value) || !std::isfinite(found.error)) {
      CHECK(std::isinf(found.error));
      CHECK(exponent > 320);
      continue;
    }
    CHECK(abs(exact_rational(found.value) - truth * factor * factor * factor) <= exact_rational(found.error));
  }
}

}  // namespace nef::test
