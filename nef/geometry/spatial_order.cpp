// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/spatial_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nef {
namespace {

constexpr unsigned kBits = 21;  // an axis: three make a word

// Two zeros before each of the lower 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32U) & 0x001f00000000ffffULL;
  x = (x | x << 16U) & 0x001f0000ff0000ffULL;
  x = (x | x << 8U) & 0x100f00f00f00f00fULL;
  x = (x | x << 4U) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2U) & 0x1249249249249249ULL;
}

bool finite(const std::array<double, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

// Cells along the curve with the points in them, in this order.
std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_keys(std::span<const std::array<double, 3>> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  double size = 0;  // of the longest side: cells are cubes
  for (const auto& p : points) {
    if (!finite(p)) continue;
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]);
  }
  for (const auto& p : points) {
    if (!finite(p)) continue;
    for (std::size_t i = 0; i < 3; ++i) size = std::max(size, p[i] - low[i]);
  }
  constexpr double kCells = (1U << kBits) - 1;
  const double scale = size > 0 && size < kInfinity ? kCells / size : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    std::uint64_t key = std::numeric_limits<std::uint64_t>::max();
    if (finite(points[v])) {
      key = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double cell = std::min(kCells, (points[v][i] - low[i]) * scale);
        key |= spread(static_cast<std::uint64_t>(cell)) << i;
      }
    }
    keys[v] = {key, v};
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<std::uint32_t> indices_of(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) {
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& key : keys) order.push_back(key.second);
  return order;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points) {
  return indices_of(sorted_keys(points));
}

std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points,
                                         const std::function<bool(std::uint32_t, std::uint32_t)>& less) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys = sorted_keys(points);
  for (auto begin = keys.begin(); begin != keys.end();) {
    auto end = begin + 1;
    while (end != keys.end() && end->first == begin->first) ++end;
    if (end - begin > 1) {
      std::sort(begin, end, [&less](const auto& a, const auto& b) { return less(a.second, b.second); });
    }
    begin = end;
  }
  return indices_of(keys);
}

}  // namespace nef
