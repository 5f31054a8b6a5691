// SPDX-License-Identifier: Apache-2.0
//
// Equal items of a long list, found on several threads.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "nef/base/threads/shared_out.h"

namespace nef {

/// Spreads what differs in any bit over all bits, of which first_equal() needs the highest ones. Different numbers stay
/// different.
inline std::uint64_t mixed_bits(std::uint64_t x) {
  x = (x ^ x >> 32U) * 0xd6e8feb86659fd93ULL;
  x = (x ^ x >> 32U) * 0xd6e8feb86659fd93ULL;
  return x ^ x >> 32U;
}

/// For each i of 0 .. count - 1 the least number of an equal item, which is i where nothing before it equals it.
/// hash(i), the same for equal items, has mixed bits; equal(i, k) is asked of items of one hash. Neither asks
/// predicates. `count` is below 2^32. Expected O(count), the same for any number of threads.
template <typename Hash, typename Equal>
std::vector<std::uint32_t> first_equal(std::size_t count, const Monitor& monitor, const Hash& hash,
                                       const Equal& equal) {
  struct Item {
    std::uint64_t hash;
    std::uint32_t number;
  };
  static_assert(kShares == 16);
  const auto shares = shared_out<Item>(count, monitor, [&](std::size_t i, const auto& put) {
    const std::uint64_t of_item = hash(i);
    put(of_item >> 60U, Item{of_item, static_cast<std::uint32_t>(i)});
  });
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> result(count);
  parallel_for(kShares, monitor, [&](std::size_t share, const Monitor&) {
    const std::vector<Item>& items = shares[share];
    // Open addressing, at most half full; a slot holds a place among the items of the share.
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * items.size() + 1), kFree);
    const std::size_t mask = slots.size() - 1;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      const Item& item = items[i];
      std::size_t at = item.hash & mask;
      while (slots[at] != kFree &&
             (items[slots[at]].hash != item.hash || !equal(items[slots[at]].number, item.number))) {
        at = (at + 1) & mask;
      }
      if (slots[at] == kFree) slots[at] = i;
      result[item.number] = items[slots[at]].number;
    }
  });
  return result;
}

/// Numbers of different items in the order in which they first come.
struct FirstNumbers {
  std::vector<std::uint32_t> number;  ///< of each item
  std::vector<std::uint32_t> first;   ///< for each number the first item that has it
};

/// What first_equal() has found, as numbers. O(items).
inline FirstNumbers numbers_by_first(std::vector<std::uint32_t>&& first_equal) {
  FirstNumbers result{std::move(first_equal), {}};
  for (std::uint32_t i = 0; i < result.number.size(); ++i) {
    std::uint32_t& number = result.number[i];
    if (number == i) {
      number = static_cast<std::uint32_t>(result.first.size());
      result.first.push_back(i);
    } else {
      number = result.number[number];
    }
  }
  return result;
}

}  // namespace nef
