// SPDX-License-Identifier: Apache-2.0
//
// The filters of meshes against rational arithmetic, where their errors are worst.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "nef/geometry/vectors.h"
#include "nef/io/number_text.h"
#include "nef/mesh/mesh_points.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::test {

TEST_CASE("determinants of mesh points: the bound holds where the error is worst", "[bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const double found = worst(bits, 13, bits, [](const Genes& g) {
      std::array<Rational3, 4> p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = point_of_genes(g, 3 * i, 12);
      const MeshPoints points(p);
      const Approximation rough = points.determinant(0, 1, 2, 3);
      const Rational truth = dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
      return part_of(exact_rational(rough.value) - truth, rough.error);
    });
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 64);
  }
}

TEST_CASE("margins of mesh points hold where the error is worst", "[bounds]") {
  const double found = worst(3, 4, 62, [](const Genes& g) {
    const std::array<Rational3, 2> p{point_of_genes(g, 0, 3), Rational3{1, 1, 1}};
    const MeshPoints points(p);
    double part = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      part = std::max(part, part_of(exact_rational(points.approximate(0)[i]) - p[0][i], points.margin(i)));
    }
    return part;
  });
  INFO(found);
  CHECK(found <= 1);
  CHECK(found > 1.0 / 16);
}

namespace {

// A number near a double, as MeshPoints::near has it: the double, its shortest decimal, or nearly half a unit off.
Rational near_double(double x, int how) {
  if (how == 0) return exact_rational(x);
  if (how == 1) {
    std::string text;
    append_number(text, x);
    return parse_rational(text);
  }
  const Rational unit = exact_rational(std::nextafter(std::abs(x), HUGE_VAL)) - exact_rational(std::abs(x));
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return exact_rational(x) + unit * Rational(static_cast<long>(bits * 0x9e3779b97f4a7c15U >> 60U) - 7, 17);
}

}  // namespace

TEST_CASE("What points near doubles answer holds for all such points", "[bounds][fast]") {
  std::mt19937 random(3);
  int answered = 0;
  int open = 0;
  const auto compared = [&](const auto& question, const MeshPoints& near, std::span<const MeshPoints> exact) {
    try {
      const int answer = question(near);
      ++answered;
      for (const MeshPoints& points : exact) CHECK(question(points) == answer);
    } catch (const OpenQuestion&) {
      ++open;
    }
  };
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::array<double, 3>> doubles(4);
    for (auto& p : doubles) {
      for (double& x : p) {
        x = (static_cast<double>(random() % 5) - 2) / 10;
        if (random() % 8 == 0) x = std::nextafter(x, random() % 2 == 0 ? HUGE_VAL : -HUGE_VAL);
        if (random() % 4 == 0) x += static_cast<double>(random() % 1000) * 0x1p-60;
      }
    }
    std::vector<MeshPoints> exact;
    for (const int how : {0, 1, 2}) {
      std::vector<Rational3> points;
      for (const auto& p : doubles) {
        points.push_back({near_double(p[0], how), near_double(p[1], how), near_double(p[2], how)});
      }
      exact.emplace_back(points);
    }
    const MeshPoints near = MeshPoints::near(doubles);
    compared([](const MeshPoints& points) { return points.orientation(0, 1, 2, 3, {}); }, near, exact);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      compared([&](const MeshPoints& points) { return points.orientation_along(0, 1, 2, axis, {}); }, near, exact);
      compared([&](const MeshPoints& points) { return points.compare(0, 1, axis); }, near, exact);
    }
  }
  CHECK(answered > 4000);
  CHECK(open > 400);
}

}  // namespace nef::test
