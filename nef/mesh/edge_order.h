// SPDX-License-Identifier: Apache-2.0
//
// Sorting by pairs of small indices, as edges of meshes are sorted by their vertices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/threads/group_by.h"

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
  std::vector<Item> sorted(items.size());
  const std::vector<std::uint32_t> begin = group_by(
      count,
      [&items](const auto& visit) {
        for (const Item& item : items) visit(static_cast<std::uint32_t>(item.key >> 32U), item);
      },
      [&sorted](std::uint32_t place, const Item& item) { sorted[place] = item; }, Monitor());
  for (std::size_t g = 0; g < count; ++g) {
    sort_short(std::span(sorted).subspan(begin[g], begin[g + 1] - begin[g]),
               [](const Item& a, const Item& b) { return a.key < b.key; });
  }
  items = std::move(sorted);
}

}  // namespace nef
