// SPDX-License-Identifier: Apache-2.0
//
// Hulls, checks of meshes and imports at sizes where products of doubles overflow or vanish, against the same at
// ordinary sizes.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "nef/construct/convex_hull.h"
#include "nef/mesh/mesh_check.h"
#include "tests/support/numbers/magnitudes.h"
#include "tests/support/shapes/machine_parts.h"

namespace nef::test {
namespace {

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double operator()() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(random_() % n); }
  Rational3 point(double size, const std::array<double, 3>& at = {}) {
    Rational3 p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = exact_rational(at[i] + size * (*this)());
    return p;
  }

 private:
  std::mt19937_64 random_;
};

// A few triangles that cross, touch and share corners, a third of them on a grid.
Mesh crossing_triangles(Numbers& random, bool on_grid) {
  Mesh mesh;
  const std::size_t triangles = 3 + random.below(3);
  for (std::size_t i = 0; i < 2 * triangles + 2; ++i) {
    Rational3 p = random.point(1);
    for (std::size_t k = 0; k < 3 && on_grid; ++k) p[k] = exact_rational(random.below(4) / 3.0);
    mesh.vertices.push_back(p);
  }
  while (mesh.face_count() < triangles) {
    std::array<std::uint32_t, 3> face{};
    for (std::uint32_t& v : face) v = random.below(mesh.vertices.size());
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) mesh.push_face(face);
  }
  return mesh;
}

// Small and far from the origin, so that its volume is a small difference of large products.
Mesh far_tetrahedron(Numbers& random) {
  Mesh mesh;
  const std::array<double, 3> at{random(), random(), random()};
  const double size = std::pow(10.0, -static_cast<double>(random.below(8)));
  for (int i = 0; i < 4; ++i) mesh.vertices.push_back(random.point(size, at));
  for (const auto& face : {std::array{0U, 1U, 2U}, {0U, 3U, 1U}, {1U, 3U, 2U}, {2U, 3U, 0U}}) mesh.push_face(face);
  return mesh;
}

std::string what_is_wrong(const Mesh& mesh) {
  std::string text;
  for (const MeshProblem& problem : check_mesh(mesh)) {
    text += name(problem.kind);
    for (const std::uint32_t v : problem.vertices) text += " " + std::to_string(v);
    text += " /";
    for (const std::uint32_t f : problem.faces) text += " " + std::to_string(f);
    text += "; ";
  }
  return text;
}

std::vector<std::uint32_t> extreme_points(const std::vector<Rational3>& points) {
  std::vector<std::uint32_t> result = hull_of(points).source;
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("meshes of any magnitude: hulls have the same corners", "[bounds]") {
  Numbers random(7);
  for (int cloud = 0; cloud < 16; ++cloud) {
    std::vector<Rational3> points;
    const std::array<double, 3> at{random(), random(), random()};
    for (int i = 0; i < 40; ++i) {
      Rational3 p = random.point(1, at);
      // Half of them all but flat: signs that filters leave open.
      const double flat = 0.3 * nearest_double(p[0]) + 0.1 * nearest_double(p[1]);
      if (cloud % 2 == 1) p[2] = exact_rational(at[2] + flat + (i % 4 == 0 ? 1e-15 * random() : 0));
      points.push_back(p);
    }
    const std::vector<std::uint32_t> expected = extreme_points(points);
    for (const long exponent : kExponents) {
      INFO("cloud " << cloud << " times 2^" << exponent);
      const Rational factor = power_of_two(exponent);
      std::vector<Rational3> large;
      for (const Rational3& p : points) large.push_back(scaled(p, factor));
      CHECK(extreme_points(large) == expected);
    }
  }
}

TEST_CASE("meshes of any magnitude: the same is wrong with them", "[bounds]") {
  Numbers random(7);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 60; ++i) meshes.push_back(crossing_triangles(random, i % 3 == 0));
  for (int i = 0; i < 60; ++i) meshes.push_back(far_tetrahedron(random));
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string expected = what_is_wrong(meshes[i]);
    for (const long exponent : kExponents) {
      INFO("mesh " << i << " times 2^" << exponent);
      CHECK(what_is_wrong(scaled(meshes[i], power_of_two(exponent))) == expected);
    }
  }
}

TEST_CASE("meshes of any magnitude: sets and their unions are the same", "[bounds]") {
  const std::array<ProfilePoint, 5> profile{{{1, 0}, {2, 0.1}, {2.2, 1}, {1.5, 0.7}, {1.1, 1.2}}};
  const Mesh standing = turned_part(profile, 7, 0.3);
  const Mesh lying = turned_part(profile, 9, 0.1, true);
  const Polyhedron expected = unite(from_mesh(standing), from_mesh(lying));
  for (const long exponent : kExponents) {
    INFO("times 2^" << exponent);
    const Rational factor = power_of_two(exponent);
    CHECK(
        equal(unite(from_mesh(scaled(standing, factor)), from_mesh(scaled(lying, factor))), scaled(expected, factor)));
  }
}

// Edges whose ends round to the same double, or nearly, have directions all the same.
TEST_CASE("meshes of any magnitude: corners that differ by less than the smallest double", "[bounds]") {
  const Rational unit = power_of_two(-1074);
  Numbers random(3);
  for (int i = 0; i < 40; ++i) {
    INFO(i);
    Mesh mesh;
    for (int k = 0; k < 4; ++k) mesh.vertices.push_back(scaled(random.point(1), unit));
    for (const auto& face : {std::array{0U, 1U, 2U}, {0U, 3U, 1U}, {1U, 3U, 2U}, {2U, 3U, 0U}}) mesh.push_face(face);
    const Mesh large = scaled(mesh, 1 / unit);
    CHECK(what_is_wrong(large) == what_is_wrong(mesh));
    if (!what_is_wrong(large).empty()) continue;  // inside out
    CHECK(equal(from_mesh(mesh), scaled(from_mesh(large), unit)));
  }
}

}  // namespace nef::test
