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

}  // namespace nef::planner
