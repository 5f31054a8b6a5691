// SPDX-License-Identifier: Apache-2.0
//
// Mixed rotations enclose all rotations of a box, exactly; seams lead to the same rotations.
#include "apps/planner/orientation/orientation_cells.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "nef/geometry/vectors.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Quaternion quaternion_at(const Orientations::Chart& chart, const std::array<Rational, 3>& at) {
  Quaternion q = chart.origin;
  for (std::size_t k = 0; k < chart.directions.size(); ++k) {
    for (std::size_t i = 0; i < 4; ++i) q[i] += at[k] * chart.directions[k][i];
  }
  return q;
}

Rational3 turned(const Matrix3& m, const Rational3& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

template <typename Number>
Matrix3 divided(const ScaledMatrix<Number>& m) {
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = Rational(m.rows[i][j]) / Rational(m.scale);
  }
  return result;
}

Rational between(std::mt19937& random, const Rational& low, const Rational& high) {
  return low + (high - low) * ratio(static_cast<long>(random() % 9), 8);
}

Orientations some_orientations(std::mt19937& random) {
  if (random() % 3 > 0) return Orientations::all();
  return Orientations::along(
      {{1, 0, 0, 0}, {1, 0, ratio(1, 2), ratio(1, 3)}, {0, 0, 3, 2}, {-3, 0, 3, 2}, {-1, 0, 0, 0}});
}

TEST_CASE("rotations of a box are mixtures of its matrices") {
  std::mt19937 random(1);
  std::size_t tested = 0;
  for (unsigned round = 0; round < 150; ++round) {
    const Orientations orientations = some_orientations(random);
    OrientationBox<Rational> box;
    box.chart = random() % orientations.charts().size();
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = small_number(random, -1, 0, 8);
      box.high[k] = box.low[k] + ratio(static_cast<long>(random() % 8 + 1), 8);
    }
    const auto matrices = mixed_rotations(orientations, box);
    if (matrices.empty()) continue;
    CHECK(matrices.size() == (orientations.dimension() == 3 ? 27 : 3));
    for (unsigned i = 0; i < 20; ++i) {
      const Quaternion q = quaternion_at(orientations.charts()[box.chart], {between(random, box.low[0], box.high[0]),
                                                                            between(random, box.low[1], box.high[1]),
                                                                            between(random, box.low[2], box.high[2])});
      const Matrix3 rotation = divided(rotation_form(q));
      const Rational3 v{small_number(random, -5, 5, 1), small_number(random, -5, 5, 1), small_number(random, -5, 5, 1)};
      const Rational3 n{small_number(random, -5, 5, 1), small_number(random, -5, 5, 1), small_number(random, -5, 5, 1)};
      // The image of v is on no side of all of the M v, and R(q) n is between the M n, as inner pieces need it.
      const auto heights = [&](const Rational3& what) {
        std::vector<Rational> result;
        for (const auto& m : matrices) result.push_back(dot(n, turned(divided(m), what)));
        return result;
      };
      const std::vector<Rational> all = heights(v);
      const Rational at = dot(n, turned(rotation, v));
      REQUIRE(at <= *std::max_element(all.begin(), all.end()));
      REQUIRE(at >= *std::min_element(all.begin(), all.end()));
      ++tested;
    }
  }
  CHECK(tested > 1000);
}

TEST_CASE("matrices of one orientation are its rotation, and too large boxes have none") {
  const Orientations all = Orientations::all();
  CHECK(mixed_rotations(all, {0, {-1, -1, -1}, {1, 1, 1}}).empty());
  CHECK_FALSE(mixed_rotations(all, {0, {0, 0, 0}, {1, 1, 1}}).empty());
  const Rational third = ratio(1, 3);
  const Matrix3 expected = rotation_between({1, third, third, third}, {1, third, third, third});
  for (const auto& m : mixed_rotations(all, {0, {third, third, third}, {third, third, third}})) {
    CHECK(divided(m) == expected);
  }
}

TEST_CASE("seams lead to the same rotation") {
  std::mt19937 random(2);
  const Orientations orientations = Orientations::all();
  CHECK(orientations.seams().size() == 12);
  for (const ChartSeam& seam : orientations.seams()) {
    std::array<Rational, 3> here{};
    std::array<Rational, 3> there{};
    here[seam.here] = seam.side;
    there[seam.there] = seam.other_side;
    for (const auto& [a, b] : seam.others) {
      here[a] = small_number(random, -1, 1, 7);
      there[b] = seam.sign * here[a];
    }
    const Quaternion p = quaternion_at(orientations.charts()[seam.chart], here);
    const Quaternion q = quaternion_at(orientations.charts()[seam.other], there);
    CHECK(rotation_between(p, p) == rotation_between(q, q));
  }
}

TEST_CASE("orientations are found in their chart") {
  const auto at = Orientations::locate({ratio(1, 2), -2, 1, 0});
  REQUIRE(at.has_value());
  CHECK(at->chart == 1);
  CHECK(at->low == std::array<Rational, 3>{ratio(-1, 4), ratio(-1, 2), 0});
  CHECK_FALSE(Orientations::locate({0, 0, 0, 0}).has_value());
}

TEST_CASE("chains of arcs") {
  const Orientations some = Orientations::along({{1, 0, 0, 0}, {1, 0, 0, 1}, {0, 0, 0, 1}});
  CHECK(some.charts().size() == 2);
  CHECK(are_proportional(quaternion_at(some.charts()[1], {-1, 0, 0}), {-2, 0, 0, -2}));
  CHECK_FALSE(are_proportional({1, 0, 0, 0}, {1, 0, 0, 1}));
  CHECK_THROWS(Orientations::along({{1, 0, 0, 0}}));
  CHECK_THROWS(Orientations::along({{1, 0, 0, 0}, {0, 0, 0, 1}}));
}

}  // namespace
}  // namespace nef::planner::test
