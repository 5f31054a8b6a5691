// SPDX-License-Identifier: Apache-2.0
//
// Three planes in doubles that are off by what they say at most: where the exact planes meet, in rationals.
#include "apps/visual_hull/viewing_edges/plane_triple.h"

#include <catch2/catch.hpp>

#include "nef/geometry/vectors.h"
#include "tests/support/numbers/next_to_zero.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::visual_hull {
namespace {

using nef::exact_rational;

struct Triple {
  std::array<CubePlane, 3> planes;
  std::array<Rational3, 3> normals;  // exact
  std::array<Rational, 3> offsets;

  // A plane near a double one; `shift` is what its values are off by.
  void set(std::size_t i, const Rational3& normal, const Rational& offset, const Rational& shift) {
    CubePlane& plane = planes[i];
    for (std::size_t k = 0; k < 3; ++k) {
      plane.normal[k] = nef::nearest_double(normal[k]);
      plane.size += std::abs(plane.normal[k]);
      normals[i][k] = exact_rational(plane.normal[k]);
    }
    plane.offset = nef::nearest_double(offset);
    plane.error = nef::nearest_double(abs(shift)) * (1 + 0x1p-50);
    offsets[i] = exact_rational(plane.offset) + shift;
  }

  [[nodiscard]] Answer meet(CubePoint& at) const {
    const auto normal_cross = [this](std::size_t i, std::size_t j) {
      return nef::cross(planes[i].normal, planes[j].normal);
    };
    return meet_in_cube(planes[0], planes[1], planes[2], normal_cross(0, 1), normal_cross(0, 2), normal_cross(1, 2),
                        at);
  }

  // Nothing if they do not meet in a point.
  [[nodiscard]] std::optional<Rational3> exact() const {
    const Rational3 bc = nef::cross(normals[1], normals[2]);
    const Rational3 ca = nef::cross(normals[2], normals[0]);
    const Rational3 ab = nef::cross(normals[0], normals[1]);
    const Rational determinant = nef::dot(normals[0], bc);
    if (determinant == 0) return std::nullopt;
    Rational3 x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = -(offsets[0] * bc[k] + offsets[1] * ca[k] + offsets[2] * ab[k]) / determinant;
    }
    return x;
  }
};

Rational largest_of(const Rational3& x) {
  return std::max({Rational(abs(x[0])), Rational(abs(x[1])), Rational(abs(x[2]))});
}

// The error of the point as a part of its bound; above 1 for an answer that is wrong.
double error_of(const Triple& triple) {
  CubePoint at;
  const Answer answer = triple.meet(at);
  const std::optional<Rational3> x = triple.exact();
  if (answer == Answer::kVague) return 0;
  if (answer == Answer::kNo) return !x || largest_of(*x) > 1 - exact_rational(kOverlap) ? 0 : 2;
  if (!x) return 2;
  Rational off;
  for (std::size_t k = 0; k < 3; ++k) off = std::max(off, Rational(abs(exact_rational(at.at[k]) - (*x)[k])));
  return nef::test::part_of(off, at.error);
}

// Nine genes of normals, three of a point of the cube, three of how much the planes are off, one to divide by.
Triple triple_of(const nef::test::Genes& g, unsigned bits, int exponent) {
  Rational unit;
  mpz_ui_pow_ui(unit.get_num_mpz_t(), 2, bits);
  const Rational small = exact_rational(std::ldexp(1.0, exponent));
  const Rational3 point{g[9] / unit, g[10] / unit, g[11] / unit};
  Triple triple;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational3 normal{g[3 * i] / unit, g[3 * i + 1] / unit, g[3 * i + 2] / unit};
    triple.set(i, normal, -nef::dot(normal, point), g[12 + i] / unit * small);
  }
  return triple;
}

}  // namespace

TEST_CASE("Where three planes meet is off by less than its bound", "[bounds]") {
  constexpr unsigned kBits = 50;
  SECTION("by rounding") {
    const double part = nef::test::worst(1, 15, kBits, [](const nef::test::Genes& g) {
      return error_of(triple_of(g, kBits, -2000));  // as good as exact planes
    });
    CAPTURE(part);
    CHECK(part <= 1);
    CHECK(part > 1.0 / 4096);
  }
  SECTION("by planes that are off") {
    const double part =
        nef::test::worst(2, 15, kBits, [](const nef::test::Genes& g) { return error_of(triple_of(g, kBits, -30)); });
    CAPTURE(part);
    CHECK(part <= 1);
    CHECK(part > 0.5);
  }
}

// The third plane is nearly a combination of the other two, or the point next to the border of the cube.
TEST_CASE("Three planes that nearly have a line in common, or meet at the border of the cube", "[bounds]") {
  nef::test::NextToZero random(11);
  std::size_t yes = 0;
  std::size_t no = 0;
  for (int round = 0; round < 30000; ++round) {
    Rational3 point{random.share() * 2 - 1, random.share() * 2 - 1, random.share() * 2 - 1};
    if (random.below(2) == 0) point[random.below(3)] = (random.below(2) == 0 ? 1 : -1) + random.tiny();
    Triple triple;
    std::array<Rational3, 3> normals{random.point(20), random.point(20), random.point(20)};
    if (random.below(2) == 0) {
      for (std::size_t k = 0; k < 3; ++k) normals[2][k] = normals[0][k] + 3 * normals[1][k];
      normals[2][random.below(3)] += random.tiny();
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational shift = random.below(2) == 0 ? Rational(0) : random.tiny();
      triple.set(i, normals[i], -nef::dot(normals[i], point), shift);
    }
    CHECK(error_of(triple) <= 1);
    CubePoint at;
    const Answer answer = triple.meet(at);
    yes += answer == Answer::kYes ? 1U : 0U;
    no += answer == Answer::kNo ? 1U : 0U;
    // No two of the planes whose point is in the cube may be told to miss it.
    const std::optional<Rational3> x = triple.exact();
    if (!x || largest_of(*x) > 1) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const CubePlane& p = triple.planes[i];
      const CubePlane& q = triple.planes[(i + 1) % 3];
      CHECK(may_meet_in_cube(p, q, nef::cross(p.normal, q.normal)));
    }
  }
  CHECK(yes > 1000);
  CHECK(no > 1000);
}

}  // namespace nef::visual_hull
