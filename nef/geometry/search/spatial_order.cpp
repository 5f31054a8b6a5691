// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/search/spatial_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "nef/base/threads/parallel.h"

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

bool comes_before(const SpatialKey& a, const SpatialKey& b) {
  return a.cell != b.cell ? a.cell < b.cell : a.index < b.index;
}

constexpr unsigned kDigit = 11;
constexpr std::size_t kPlaces = std::size_t{1} << kDigit;

// One turn of a radix sort: `from` in the order of the digit from bit `shift` on, equal ones as they come. Each thread
// counts the digits of its part and then writes to places of its own. False if all have one digit; then nothing is
// written.
bool sort_by_digit(std::span<const SpatialKey> from, std::span<SpatialKey> to, unsigned shift, const Monitor& monitor) {
  using Places = std::array<std::uint32_t, kPlaces>;
  const auto digit = [shift](const SpatialKey& key) { return key.cell >> shift & (kPlaces - 1); };
  const std::size_t size = size_of_ranges(from.size(), monitor);
  std::vector<Places> places((from.size() + size - 1) / size, Places{});
  parallel_for_ranges(from.size(), size, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    for (const SpatialKey& key : from.subspan(first, last - first)) ++places[first / size][digit(key)];
  });
  std::uint32_t next = 0;
  for (std::size_t d = 0; d < kPlaces; ++d) {
    const std::uint32_t before = next;
    for (Places& of_part : places) next += std::exchange(of_part[d], next);
    if (next - before == from.size()) return false;
  }
  parallel_for_ranges(from.size(), size, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    Places place = places[first / size];
    for (const SpatialKey& key : from.subspan(first, last - first)) to[place[digit(key)]++] = key;
  });
  return true;
}

// By cell, then by index. The upper bits in turns of so many that a table of as many places as they tell apart stays in
// the fastest cache; they part all but a few keys, which then are compared.
void sort_by_cell(std::vector<SpatialKey>& keys, const Monitor& monitor) {
  constexpr std::size_t kFew = 2000;  // sorted faster by comparing
  if (keys.size() < kFew) {
    std::sort(keys.begin(), keys.end(), comes_before);
    return;
  }
  constexpr unsigned kTop = 64;
  const unsigned turns = std::bit_width(keys.size()) < 20 ? 3 : 4;
  const unsigned lowest = kTop - turns * kDigit;
  std::vector<SpatialKey> sorted(keys.size());
  for (unsigned shift = lowest; shift < kTop; shift += kDigit) {
    if (sort_by_digit(keys, sorted, shift, monitor)) keys.swap(sorted);
  }
  for (auto begin = keys.begin(); begin != keys.end();) {
    auto end = begin + 1;
    while (end != keys.end() && end->cell >> lowest == begin->cell >> lowest) ++end;
    if (end - begin > 1) std::sort(begin, end, comes_before);
    begin = end;
  }
}

}  // namespace

std::vector<SpatialKey> spatial_keys(std::span<const std::array<double, 3>> points, const Monitor& monitor) {
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
  const auto key = [&](std::size_t v) -> SpatialKey {
    if (!finite(points[v])) return {std::numeric_limits<std::uint64_t>::max(), static_cast<std::uint32_t>(v)};
    std::uint64_t cell = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      cell |= spread(static_cast<std::uint64_t>(std::min(kCells, (points[v][i] - low[i]) * scale))) << i;
    }
    return {cell, static_cast<std::uint32_t>(v)};
  };
  const Monitor own = for_vertices(points.size(), monitor);
  std::vector<SpatialKey> keys = vector_of(points.size(), own, key);
  sort_by_cell(keys, own);
  return keys;
}

std::vector<std::uint32_t> spatial_order(std::span<const std::array<double, 3>> points,
                                         const std::function<bool(std::uint32_t, std::uint32_t)>& less) {
  std::vector<SpatialKey> keys = spatial_keys(points);
  for (auto begin = keys.begin(); begin != keys.end();) {
    auto end = begin + 1;
    while (end != keys.end() && end->cell == begin->cell) ++end;
    if (end - begin > 1) {
      std::sort(begin, end, [&less](const auto& a, const auto& b) { return less(a.index, b.index); });
    }
    begin = end;
  }
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const SpatialKey& key : keys) order.push_back(key.index);
  return order;
}

}  // namespace nef
