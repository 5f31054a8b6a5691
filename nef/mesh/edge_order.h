// SPDX-License-Identifier: Apache-2.0
//
// Sorting by pairs of small indices, as edges of meshes are sorted by their vertices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nef {

/// The pair in one number, whose order is the lexicographic one.
inline std::uint64_t pair_key(std::uint32_t first, std::uint32_t second) {
  return static_cast<std::uint64_t>(first) << 32U | second;
}

/// The key of an edge, whichever way it is run through.
inline std::uint64_t edge_key(std::uint32_t u, std::uint32_t v) { return pair_key(std::min(u, v), std::max(u, v)); }

/// Sorts items by their member `key` (a pair_key whose first index is below `count`); equal ones keep their order.
/// One counting pass by the first index, then each group on its own: O(n + count) while groups are small.
template <typename Item>
void sort_by_pair(std::vector<Item>& items, std::size_t count) {
  std::vector<std::uint32_t> begin(count + 1, 0);
  for (const Item& item : items) ++begin[(item.key >> 32U) + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Item> sorted(items.size());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for (const Item& item : items) sorted[at[item.key >> 32U]++] = item;
  constexpr std::uint32_t kSmall = 24;
  for (std::size_t g = 0; g < count; ++g) {
    if (begin[g + 1] - begin[g] > kSmall) {
      std::stable_sort(sorted.begin() + begin[g], sorted.begin() + begin[g + 1],
                       [](const Item& a, const Item& b) { return a.key < b.key; });
      continue;
    }
    for (std::uint32_t i = begin[g] + 1; i < begin[g + 1]; ++i) {
      const Item item = sorted[i];
      std::uint32_t j = i;
      for (; j > begin[g] && item.key < sorted[j - 1].key; --j) sorted[j] = sorted[j - 1];
      sorted[j] = item;
    }
  }
  items = std::move(sorted);
}

}  // namespace nef
