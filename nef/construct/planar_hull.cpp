// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/planar_hull.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "nef/base/fast_path.h"
#include "nef/geometry/monotone_chain.h"
#include "nef/number/approximation.h"

namespace nef::detail {

std::vector<std::uint32_t> linear_hull(std::span<const Rational3> points, const Rational3& direction) {
  // Order along a line is the order of any coordinate in which it is not constant.
  std::size_t axis = 0;
  while (sgn(direction[axis]) == 0) ++axis;
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    if (points[i][axis] < points[low][axis]) low = i;
    if (points[i][axis] > points[high][axis]) high = i;
  }
  return {low, high};
}

std::vector<std::uint32_t> planar_hull(std::span<const Rational3> points, const Rational3& normal) {
  // Drop a coordinate in which the normal is not zero; keep the orientation.
  std::size_t axis = 0;
  while (sgn(normal[axis]) == 0) ++axis;
  std::size_t u = (axis + 1) % 3;
  std::size_t v = (axis + 2) % 3;
  if (sgn(normal[axis]) < 0) std::swap(u, v);

  std::vector<std::array<Approximation, 2>> near;  // doubles tell most signs
  near.reserve(points.size());
  for (const Rational3& p : points) near.push_back({approximation_of(p[u]), approximation_of(p[v])});
  const auto sure = [](const Approximation& x) { return kFastPaths ? x.sign() : std::nullopt; };
  const auto compare = [&](std::uint32_t a, std::uint32_t b, std::size_t k) {
    const std::size_t of = k == 0 ? u : v;
    if (const std::optional<int> sign = sure(near[a][k] - near[b][k])) return *sign;
    return cmp(points[a][of], points[b][of]);
  };

  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int sign = compare(a, b, 0);
    if (sign != 0) return sign < 0;
    const int sign_v = compare(a, b, 1);
    return sign_v != 0 ? sign_v < 0 : a < b;
  });
  order.erase(
      std::unique(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return compare(a, b, 0) == 0 && compare(a, b, 1) == 0; }),
      order.end());

  const auto left_turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::optional<int> sign = sure((near[b][0] - near[a][0]) * (near[c][1] - near[a][1]) -
                                         (near[b][1] - near[a][1]) * (near[c][0] - near[a][0]));
    if (sign) return *sign > 0;
    const Rational left = (points[b][u] - points[a][u]) * (points[c][v] - points[a][v]);
    const Rational right = (points[b][v] - points[a][v]) * (points[c][u] - points[a][u]);
    return left > right;
  };
  return convex_hull_of_sorted(std::move(order), left_turn);
}

}  // namespace nef::detail
