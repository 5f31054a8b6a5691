// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/check/check_parts.h"

#include <algorithm>

#include "nef/geometry/vectors.h"

namespace nef::planner {

bool is_flat(std::span<const Rational3> piece) {
  std::vector<Rational3> sides;
  for (const Rational3& p : piece) sides.push_back(minus(p, piece.front()));
  Rational3 normal{};
  for (const Rational3& first : sides) {
    for (const Rational3& second : sides) {
      if (is_zero(normal)) normal = cross(first, second);
    }
  }
  return std::all_of(sides.begin(), sides.end(), [&](const Rational3& side) { return dot(normal, side) == 0; });
}

std::optional<Rational3> weighted_sum(std::span<const Rational3> points, std::span<const Rational> weights,
                                      bool positive) {
  if (weights.size() != points.size()) return std::nullopt;
  Rational3 sum;
  Rational all = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights[i] < 0 || (positive && weights[i] == 0)) return std::nullopt;
    all += weights[i];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[i] * points[i][k];
  }
  if (all != 1) return std::nullopt;
  return sum;
}

std::vector<Rational3> outer_planes(std::span<const Rational3> vectors) {
  std::vector<Rational3> result;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Rational3 n = cross(vectors[i], vectors[j]);
      Rational least = 0;
      Rational most = 0;
      for (const Rational3& v : vectors) {
        const Rational at = dot(n, v);
        least = std::min(least, at);
        most = std::max(most, at);
      }
      if (least < 0 && most == 0) result.push_back(n);
      if (least == 0 && most > 0) result.push_back(opposite(n));
    }
  }
  return result;
}

bool is_beyond_a_side(const std::optional<std::array<Rational3, 2>>& box, std::span<const Rational3> points) {
  if (!box) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto below = [&](const Rational3& p) { return p[k] < (*box)[0][k]; };
    const auto above = [&](const Rational3& p) { return p[k] > (*box)[1][k]; };
    if (std::all_of(points.begin(), points.end(), below)) return true;
    if (std::all_of(points.begin(), points.end(), above)) return true;
  }
  return false;
}

namespace {

std::optional<bool> crosses(const std::array<Rational3, 3>& corners, const Rational3& from,
                            const Rational3& direction) {
  std::array<int, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = sgn(dot(direction, cross(minus(corners[k], from), minus(corners[(k + 1) % 3], from))));
  }
  if (*std::min_element(sides.begin(), sides.end()) < 0 && *std::max_element(sides.begin(), sides.end()) > 0) {
    return false;  // the line misses the triangle
  }
  if (std::any_of(sides.begin(), sides.end(), [](int side) { return side == 0; })) return std::nullopt;
  const Rational3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const int height = sgn(dot(normal, minus(corners[0], from)));
  if (height == 0) return std::nullopt;
  return height == sgn(dot(normal, direction));
}

}  // namespace

std::optional<bool> crosses_odd(std::span<const std::array<Rational3, 3>> triangles, const Rational3& from) {
  constexpr int kRays = 100;
  for (int ray = 0; ray < kRays; ++ray) {
    const Rational3 direction{1000, 7 + 13 * ray, 11 + 17 * ray * ray};
    bool odd = false;
    const bool told = std::all_of(triangles.begin(), triangles.end(), [&](const std::array<Rational3, 3>& triangle) {
      const std::optional<bool> crossed = crosses(triangle, from, direction);
      if (crossed && *crossed) odd = !odd;
      return crossed.has_value();
    });
    if (told) return odd;
  }
  return std::nullopt;
}

}  // namespace nef::planner
