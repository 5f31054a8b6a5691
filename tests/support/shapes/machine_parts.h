// SPDX-License-Identifier: Apache-2.0
//
// Meshes of machine parts: turned and extruded shapes as CAD programs export them, with coordinates rounded to doubles,
// so that many faces are coplanar, parallel, or nearly so.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "nef/construct/construct.h"

namespace nef::test {

/// A point of a profile: radius and height.
using ProfilePoint = std::array<double, 2>;

/// The ring that a closed profile sweeps about the z axis, in `sides` steps, begun at the angle `turn` (radians). The
/// profile is counterclockwise (radius to the right, height up) and away from the axis. 2 * sides * profile.size()
/// triangles. If `lying`, the axis is x.
inline Mesh turned_part(std::span<const ProfilePoint> profile, std::uint32_t sides, double turn, bool lying = false) {
  Mesh mesh;
  for (const auto& [radius, height] : profile) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides + turn;
      const Rational x = exact_rational(radius * std::cos(angle));
      const Rational y = exact_rational(radius * std::sin(angle));
      const Rational z = exact_rational(height);
      mesh.vertices.push_back(lying ? Rational3{z, x, y} : Rational3{x, y, z});
    }
  }
  const auto rings = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t i = 0; i < rings; ++i) {
    const std::uint32_t j = (i + 1) % rings;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t l = (k + 1) % sides;
      mesh.push_face(std::array{i * sides + k, i * sides + l, j * sides + l});
      mesh.push_face(std::array{i * sides + k, j * sides + l, j * sides + k});
    }
  }
  return mesh;
}

/// A prism over a simple polygon that runs counterclockwise: 4 * outline.size() - 4 triangles, as faces that are whole.
inline Mesh extruded_part(std::span<const std::array<double, 2>> outline, double height) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : outline)
      mesh.vertices.push_back({exact_rational(x), exact_rational(y), exact_rational(z)});
  }
  std::vector<std::uint32_t> low;
  std::vector<std::uint32_t> high;
  for (std::uint32_t i = 0; i < n; ++i) {
    low.push_back(n - 1 - i);
    high.push_back(n + i);
  }
  mesh.push_face(low);
  mesh.push_face(high);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.push_face(std::array{i, j, n + j, n + i});
  }
  return mesh;
}

/// The outline of a gear: eight corners a tooth, which stands `depth` above `radius`.
inline std::vector<std::array<double, 2>> gear_outline(std::size_t teeth, double radius, double depth) {
  constexpr std::array<double, 8> kTooth = {0, 0, 0.2, 0.7, 1, 1, 0.7, 0.2};
  std::vector<std::array<double, 2>> outline;
  for (std::size_t t = 0; t < teeth; ++t) {
    for (std::size_t k = 0; k < kTooth.size(); ++k) {
      const double place = static_cast<double>(t) + static_cast<double>(k) / static_cast<double>(kTooth.size());
      const double angle = 2 * std::numbers::pi * place / static_cast<double>(teeth);
      const double r = radius + depth * kTooth[k];
      outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  }
  return outline;
}

/// A flange with a hub and a stepped bore: 1200 triangles with 30 sides.
inline constexpr std::array<ProfilePoint, 20> kFlange = {
    {{10, 0},    {14, 0},  {14, 2},  {16, 2},  {16.5, 2.5}, {16.5, 5}, {16, 5.5}, {13, 5.5}, {12.5, 6}, {12.5, 12},
     {13, 12.5}, {13, 16}, {12, 17}, {10, 17}, {9.6, 16.8}, {9.6, 12}, {8, 12},   {8, 8},    {9, 8},    {9, 1}}};

/// A plain bushing with a collar.
inline constexpr std::array<ProfilePoint, 8> kBushing = {
    {{10, 0}, {14, 0}, {14, 2}, {16, 2}, {16, 5}, {13, 6}, {12.5, 12}, {10, 12}}};

}  // namespace nef::test
