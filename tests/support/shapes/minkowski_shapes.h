// SPDX-License-Identifier: Apache-2.0
//
// Meshes that are made rather than stored, for tests and benchmarks of Minkowski sums.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"

namespace nef::test {

/// A rational of six decimals next to a double.
inline Rational six_decimals(double value) {
  Rational result(Integer(std::lround(value * 1e6)), Integer(1000000));
  result.canonicalize();
  return result;
}

/// A mushroom: a surface of revolution with 14 rings of 16 vertices and two poles (226 vertices, 448
/// triangles). Each ring is turned a little against the one below, and quadrangles are cut the hollow way, so
/// about as many edges are reflex (208) as in the mushroom of the thesis (213).
inline Mesh mushroom() {
  constexpr std::array<std::array<double, 2>, 14> kProfile = {{{0.30, 0.00},  // radius and height of each ring
                                                               {0.33, 0.06},
                                                               {0.31, 0.20},
                                                               {0.28, 0.35},
                                                               {0.27, 0.50},
                                                               {0.28, 0.62},
                                                               {0.55, 0.60},
                                                               {0.82, 0.56},
                                                               {1.00, 0.58},
                                                               {1.05, 0.66},
                                                               {0.98, 0.80},
                                                               {0.80, 0.95},
                                                               {0.55, 1.07},
                                                               {0.28, 1.14}}};
  constexpr std::uint32_t kRound = 16;
  Mesh mesh;
  for (std::size_t ring = 0; ring < kProfile.size(); ++ring) {
    for (std::uint32_t k = 0; k < kRound; ++k) {
      const double angle = 2 * M_PI * k / kRound + 0.05 * static_cast<double>(ring);
      mesh.vertices.push_back({six_decimals(kProfile[ring][0] * std::cos(angle)),
                               six_decimals(kProfile[ring][0] * std::sin(angle)), six_decimals(kProfile[ring][1])});
    }
  }
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({Rational(0), Rational(0), six_decimals(-0.02)});
  mesh.vertices.push_back({Rational(0), Rational(0), six_decimals(1.17)});
  const auto triangle = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::array<std::uint32_t, 3> face = {a, b, c};
    mesh.push_face(face);
  };
  const auto last = static_cast<std::uint32_t>((kProfile.size() - 1) * kRound);
  for (std::uint32_t k = 0; k < kRound; ++k) {
    const std::uint32_t next = (k + 1) % kRound;
    triangle(bottom, next, k);
    triangle(bottom + 1, last + k, last + next);
    for (std::uint32_t ring = 0; ring + 1 < kProfile.size(); ++ring) {
      const std::uint32_t low = ring * kRound;
      const std::uint32_t high = low + kRound;
      triangle(low + k, low + next, high + k);
      triangle(low + next, high + next, high + k);
    }
  }
  return mesh;
}

/// A star: a spike of length `spike` on each facet of an octahedron of radius 1 whose edges are split. 8
/// facets give 14 vertices like the published star, two splits 32 facets and 50 vertices.
inline Mesh star(int splits, double spike) {
  std::vector<Rational3> core;
  for (int i = -splits; i <= splits; ++i) {
    for (int j = -splits; j <= splits; ++j) {
      const int rest = splits - std::abs(i) - std::abs(j);
      if (rest < 0) continue;
      for (const int k : {-rest, rest}) {
        const double length = std::sqrt(i * i + j * j + k * k);
        core.push_back({six_decimals(i / length), six_decimals(j / length), six_decimals(k / length)});
        if (rest == 0) break;
      }
    }
  }
  const Mesh inner = convex_hull_mesh(core);
  Mesh mesh;
  mesh.vertices = inner.vertices;
  for (std::size_t f = 0; f < inner.face_count(); ++f) {
    const auto face = inner.face(f);
    std::array<double, 3> tip{};
    for (const std::uint32_t v : face) {
      for (std::size_t i = 0; i < 3; ++i) tip[i] += nearest_double(inner.vertices[v][i]);
    }
    const double length = std::sqrt(tip[0] * tip[0] + tip[1] * tip[1] + tip[2] * tip[2]);
    const auto apex = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({six_decimals(spike * tip[0] / length), six_decimals(spike * tip[1] / length),
                             six_decimals(spike * tip[2] / length)});
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::array<std::uint32_t, 3> side = {face[k], face[(k + 1) % face.size()], apex};
      mesh.push_face(side);
    }
  }
  return mesh;
}

/// A geodesic sphere: an icosahedron with each edge split (10 splits^2 + 2 vertices; 5 gives 252),
/// turned by `turn` about z.
inline Mesh geodesic_sphere(int splits, double radius, double turn) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  std::vector<Rational3> corners;
  for (const int a : {-1, 1}) {
    for (const int b : {-1, 1}) {
      const Rational p(a);
      const Rational q = exact_rational(b * t);
      corners.push_back({p, q, Rational(0)});
      corners.push_back({Rational(0), p, q});
      corners.push_back({q, Rational(0), p});
    }
  }
  const Mesh icosahedron = convex_hull_mesh(corners);
  std::map<std::array<long, 3>, Rational3> points;
  for (std::size_t f = 0; f < icosahedron.face_count(); ++f) {
    const auto face = icosahedron.face(f);
    for (int i = 0; i <= splits; ++i) {
      for (int j = 0; i + j <= splits; ++j) {
        const std::array<int, 3> weight = {i, j, splits - i - j};
        std::array<double, 3> p{};
        for (std::size_t a = 0; a < 3; ++a) {
          for (std::size_t k = 0; k < 3; ++k) p[a] += weight[k] * nearest_double(icosahedron.vertices[face[k]][a]);
        }
        const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / radius;
        const double x = (p[0] * std::cos(turn) - p[1] * std::sin(turn)) / length;
        const double y = (p[0] * std::sin(turn) + p[1] * std::cos(turn)) / length;
        const std::array<long, 3> key = {std::lround(x * 1e5), std::lround(y * 1e5), std::lround(p[2] / length * 1e5)};
        points.try_emplace(key, Rational3{exact_rational(x), exact_rational(y), exact_rational(p[2] / length)});
      }
    }
  }
  std::vector<Rational3> sphere;
  for (const auto& [key, p] : points) sphere.push_back(p);
  return convex_hull_mesh(sphere);
}

}  // namespace nef::test
