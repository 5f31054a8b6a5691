// SPDX-License-Identifier: Apache-2.0
//
// Counting sort on several threads: items in groups by a small key, as faces by their vertices; and what sorts a group.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/threads/parallel.h"

namespace nef {

/// Tells where the group of each key begins among all items, and the end. for_each(visit) calls visit(key, what...) for
/// each item, in an order that is the same each time; put(place, what...) is called for each with its place, those of
/// one key in the order in which they came. `keys` is how many keys there are; items with others are left out. O(items
/// + keys), on the threads of `monitor`: each goes through all items and puts those of keys of its own.
template <typename ForEach, typename Put>
std::vector<std::uint32_t> group_by(std::size_t keys, const ForEach& for_each, const Put& put, const Monitor& monitor) {
  std::vector<std::uint32_t> begin(keys + 1, 0);
  const auto count = [&](std::size_t first, std::size_t last) {
    for_each([&](std::uint32_t key, const auto&...) {
      if (first <= key && key < last) ++begin[key + 1];
    });
  };
  std::vector<std::uint32_t> next;
  const auto place = [&](std::size_t first, std::size_t last) {
    for_each([&](std::uint32_t key, const auto&... what) {
      if (first <= key && key < last) put(next[key]++, what...);
    });
  };
  const auto in_ranges = [&](const auto& step) {
    if (monitor.threads() == 1) return step(0, keys);
    parallel_for_ranges(keys, size_of_ranges(keys, monitor), monitor,
                        [&step](std::size_t first, std::size_t last, const Monitor&) { step(first, last); });
  };
  in_ranges(count);
  for (std::size_t key = 1; key < begin.size(); ++key) begin[key] += begin[key - 1];
  next.assign(begin.begin(), begin.end() - 1);
  in_ranges(place);
  return begin;
}

/// Sorts what is short as a rule; items of which neither is less stay in their order. By insertion while they are few,
/// which is faster than std::stable_sort then, and needs no memory. O(n log n) of many.
template <typename Item, typename Less>
void sort_short(std::span<Item> items, const Less& less) {
  constexpr std::size_t kFew = 24;
  if (items.size() > kFew) {
    std::stable_sort(items.begin(), items.end(), less);
    return;
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Item item = items[i];
    std::size_t at = i;
    for (; at > 0 && less(item, items[at - 1]); --at) items[at] = items[at - 1];
    items[at] = item;
  }
}

}  // namespace nef
