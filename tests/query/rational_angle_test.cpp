// SPDX-License-Identifier: Apache-2.0
//
// Rational rotations: exactly orthogonal, within tolerance (against libm), and as simple as can be.
#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/number/simplest_between.h"
#include "nef/operation/rational_angle.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

bool is_rotation(const AffineMap& map) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Rational dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += map.linear[i][k] * map.linear[j][k];
      if (dot != (i == j ? 1 : 0)) return false;
    }
  }
  return map.determinant() == 1;
}

constexpr double kPi = 3.14159265358979323846;

// The angle of a rotation about `axis`, in degrees in (-180, 180], by its effect on a vector
// orthogonal to the axis.
double angle_of(const AffineMap& map, const Rational3& axis) {
  Rational3 u{axis[1], -axis[0], 0};
  if (axis[0] == 0 && axis[1] == 0) u = {1, 0, 0};
  const Rational3 v = map(u);
  const Rational dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const Rational3 cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const Rational along = cross[0] * axis[0] + cross[1] * axis[1] + cross[2] * axis[2];
  const Rational square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  return std::atan2(along.get_d() / std::sqrt(square.get_d()), dot.get_d()) * 180 / kPi;
}

// Tries one denominator after the other; of the numerators that fit, the one nearest to zero.
Rational brute_simplest(const Rational& low, const Rational& high) {
  if (low <= 0 && high >= 0) return 0;
  for (long q = 1;; ++q) {
    const double nearest = low > 0 ? std::ceil(low.get_d() * q - 1e-9) : std::floor(high.get_d() * q + 1e-9);
    Rational x = Rational(static_cast<long>(nearest)) / q;
    if (low <= x && x <= high) return x;
  }
}

}  // namespace

TEST_CASE("the simplest rational of an interval is the one that brute force finds") {
  CHECK(simplest_between(Rational(1, 3), Rational(1, 2)) == Rational(1, 2));
  CHECK(simplest_between(Rational(-7, 2), Rational(-10, 3)) == Rational(-7, 2));
  CHECK(simplest_between(Rational(-1, 5), Rational(1, 7)) == 0);
  CHECK_THROWS_AS(simplest_between(1, 0), InputError);
  CHECK(rc::check("simplest_between", [] {
    const Rational low = Rational(*rc::gen::inRange(-300, 300)) / *rc::gen::inRange(1, 40);
    const Rational high = low + Rational(*rc::gen::inRange(0, 30)) / *rc::gen::inRange(1, 40);
    RC_ASSERT(simplest_between(low, high) == brute_simplest(low, high));
  }));
}

TEST_CASE("rotations are orthogonal and within tolerance, about any axis") {
  CHECK(rc::check("rotation", [] {
    Rational3 axis;
    for (Rational& x : axis) x = Rational(*rc::gen::inRange(-9, 10)) / *rc::gen::inRange(1, 5);
    RC_PRE(axis[0] != 0 || axis[1] != 0 || axis[2] != 0);
    const double degrees = *rc::gen::inRange(-80000, 80000) / 64.0;
    const double tolerance = std::pow(10.0, -*rc::gen::inRange(0, 11));
    const AffineMap map = AffineMap::rotate(axis, degrees, tolerance);
    RC_ASSERT(is_rotation(map));
    RC_ASSERT(map(axis) == axis);
    double error = std::fabs(std::remainder(angle_of(map, axis) - degrees, 360));
    RC_ASSERT(error <= tolerance + 1e-11);
  }));
}

TEST_CASE("quarter turns are exact") {
  const AffineMap quarter = AffineMap::rotate({0, 0, 1}, 90);
  CHECK(quarter(Rational3{1, 0, 0}) == Rational3{0, 1, 0});
  CHECK(AffineMap::rotate({1, 0, 0}, 180)(Rational3{0, 1, 2}) == Rational3{0, -1, -2});
  CHECK(AffineMap::rotate({0, 3, 0}, -90)(Rational3{1, 5, 0}) == Rational3{0, 5, 1});
  CHECK(AffineMap::rotate({0, 1, 0}, 720)(Rational3{1, 2, 3}) == Rational3{1, 2, 3});
}

TEST_CASE("angles far below double precision keep their size") {
  // 10^-40 degrees about z: sine ~ angle, so the matrix entry tells.
  for (const double degrees : {1e-6, 1e-20, 1e-40}) {
    const AffineMap map = AffineMap::rotate({0, 0, 1}, degrees, degrees * 1e-3);
    CHECK(is_rotation(map));
    CHECK(map.linear[1][0].get_d() / (degrees * kPi / 180) == Approx(1).epsilon(2e-3));
  }
  // Around a large angle, a tolerance that no double near it could show.
  const AffineMap fine = AffineMap::rotate({0, 0, 1}, 45, 1e-40);
  const Rational off = fine.linear[0][0] - fine.linear[1][0];
  CHECK(off != 0);
  CHECK(std::fabs(off.get_d()) < 1e-40);
}

TEST_CASE("denominators stay near the least that the tolerance allows") {
  // About 1/tolerance in radians is what any rational point on the circle costs.
  const AffineMap map = AffineMap::rotate({0, 0, 1}, 33, 1e-6);
  CHECK(map.linear[0][0].get_den() < Integer("1000000000"));
  CHECK(AffineMap::rotate({0, 0, 1}, 37, 1).linear[0][0].get_den() <= 25);
}

TEST_CASE("rotations take microseconds") {
  const nef::Stopwatch watch;
  constexpr int kCount = 200;
  Rational sum = 0;
  for (int i = 0; i < kCount; ++i) sum = AffineMap::rotate({1, 2, 2}, 10.0 + i / 7.0, 1e-6).linear[0][0];
  const double each = watch.seconds() * 1e6 / kCount;
  WARN("a rotation within 1e-6 degrees takes " << each << " microseconds");
  CHECK(sum < 1);
  CHECK(each < 2000);  // generous: machines under sanitizers
}

TEST_CASE("senseless rotations are refused") {
  CHECK_THROWS_AS(AffineMap::rotate({0, 0, 0}, 10), InputError);
  CHECK_THROWS_AS(AffineMap::rotate({0, 0, 1}, 10, 0), InputError);
  CHECK_THROWS_AS(AffineMap::rotate({0, 0, 1}, std::nan("")), InputError);
}

TEST_CASE("maps compose from right to left") {
  const AffineMap move = AffineMap::translate({1, 2, 3});
  const AffineMap grow = AffineMap::scale({2, 3, 4});
  CHECK(grow.after(move)(Rational3{1, 1, 1}) == Rational3{4, 9, 16});
  CHECK(move.after(grow)(Rational3{1, 1, 1}) == Rational3{3, 5, 7});
  CHECK(grow.after(move).determinant() == 24);
}

}  // namespace nef
