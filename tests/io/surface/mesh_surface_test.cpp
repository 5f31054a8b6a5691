// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/surface/mesh_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

namespace nef::test {
namespace {

// The smallest vertex at the same point, looked for among all.
std::vector<std::uint32_t> first_equal(const std::vector<Rational3>& points) {
  std::vector<std::uint32_t> result;
  for (const Rational3& point : points) {
    result.push_back(static_cast<std::uint32_t>(std::find(points.begin(), points.end(), point) - points.begin()));
  }
  return result;
}

}  // namespace

TEST_CASE("Vertices at one point are merged, whatever numbers they have and however dense they lie") {
  std::mt19937 random(11);
  const auto number = [&](long limit) { return static_cast<long>(random() % static_cast<unsigned long>(limit)); };
  // Integers; quotients without a small common denominator; numbers that differ in no double.
  const std::vector<Rational> steps = {1, Rational(1, 3), Rational(1, 1000000007L), Rational(1, 1L << 60)};
  for (const Rational& step : steps) {
    for (const bool with_far : {false, true}) {  // then all others lie in one cell of the curve
      for (const long side : {2L, 4L, 40L}) {
        Mesh mesh;
        for (int i = 0; i < 300; ++i) {
          Rational3 point;
          for (Rational& x : point) x = 1 + step * number(side);
          mesh.vertices.push_back(point);
        }
        if (with_far) mesh.vertices[number(300)] = {Rational("1" + std::string(90, '0')), 0, 0};
        if (step == Rational(1, 3)) mesh.vertices[5][0] += Rational(1, 999999999989L);
        CAPTURE(step, with_far, side);
        for (const unsigned threads : {1U, 2U}) {
          CHECK(MeshSurface(mesh, Monitor().on_threads(threads)).place == first_equal(mesh.vertices));
        }
      }
    }
  }
}

TEST_CASE("Vertices of a large mesh are merged on any number of threads") {
  std::mt19937 random(12);
  Mesh mesh;
  for (int i = 0; i < 20000; ++i) {
    Rational3 point;
    for (Rational& x : point) x = static_cast<long>(random() % 12);
    mesh.vertices.push_back(point);
  }
  const std::vector<std::uint32_t> place = first_equal(mesh.vertices);
  for (const unsigned threads : {1U, 2U, 3U, 0U})
    CHECK(MeshSurface(mesh, Monitor().on_threads(threads)).place == place);
}

}  // namespace nef::test
