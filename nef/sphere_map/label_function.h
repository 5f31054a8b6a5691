// SPDX-License-Identifier: Apache-2.0
//
// What a Boolean operation does to marks, as a table.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "nef/geometry/ids.h"

namespace nef {

/// A binary function on labels that remembers its values. kOutside with anything is kOutside. May be asked from several
/// threads at once.
class LabelFunction {
 public:
  /// f for labels below `size_a` and `size_b`. Each pair is asked for once, when it first occurs, and never two pairs
  /// at a time. What f throws passes through. Memory for the pairs that occur, or 256 kB at most.
  LabelFunction(std::size_t size_a, std::size_t size_b, std::function<LabelId(LabelId, LabelId)> f);

  /// Whichever of the two is not kOutside, the first if neither is: what glues sets beyond whose borders kOutside is.
  struct WhicheverIsInside {};
  explicit LabelFunction(WhicheverIsInside) : size_b_(0), whichever_is_inside_(true) {}

  [[nodiscard]] LabelId operator()(LabelId a, LabelId b) const {
    if (whichever_is_inside_) return a == kOutside ? b : a;
    if (a == kOutside || b == kOutside) return kOutside;
    if (!table_.empty()) {
      const std::uint32_t known = table_[a * size_b_ + b].load(std::memory_order_relaxed);
      if (known != kUnknown) return static_cast<LabelId>(known);
    }
    return ask(a, b);
  }

 private:
  static constexpr std::uint32_t kUnknown = 0xffffffffU;

  LabelId ask(LabelId a, LabelId b) const;

  std::size_t size_b_;
  bool whichever_is_inside_ = false;
  std::function<LabelId(LabelId, LabelId)> f_;
  // Of few pairs a table, of many a map.
  mutable std::vector<std::atomic<std::uint32_t>> table_;
  mutable std::unordered_map<std::uint32_t, LabelId> map_;
  mutable std::mutex mutex_;
};

}  // namespace nef
