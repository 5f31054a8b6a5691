// SPDX-License-Identifier: Apache-2.0
//
// Work whose items have names (of a line, of a plane), shared out so that all items of one name are in one share: each
// share is then done by one thread, which asks nobody.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "nef/base/threads/parallel.h"

namespace nef {

/// Enough of them for many threads; what a share needs stays in a fast cache rather than what all need.
inline constexpr std::size_t kShares = 16;

/// visit(i, put) for i = 0 .. count - 1, which calls put(share, item) for what i has, share < kShares, and asks no
/// predicates. What each share has got, by ascending i: it does not depend on the number of threads.
template <typename Item, typename Visit>
std::vector<std::vector<Item>> shared_out(std::size_t count, const Monitor& monitor, const Visit& visit) {
  // A range of numbers has lists of its own.
  std::vector<std::array<std::vector<Item>, kShares>> lists(kShares);
  const std::size_t range = (count + kShares - 1) / kShares;
  parallel_for(kShares, monitor, [&](std::size_t k, const Monitor&) {
    const auto put = [&list = lists[k]](std::size_t share, const Item& item) { list[share].push_back(item); };
    for (std::size_t i = k * range; i < std::min((k + 1) * range, count); ++i) visit(i, put);
  });
  std::vector<std::vector<Item>> shares(kShares);
  parallel_for(kShares, monitor, [&](std::size_t share, const Monitor&) {
    std::size_t size = 0;
    for (const auto& list : lists) size += list[share].size();
    shares[share].reserve(size);
    for (auto& list : lists) {
      shares[share].insert(shares[share].end(), list[share].begin(), list[share].end());
      list[share] = {};
    }
  });
  return shares;
}

}  // namespace nef
