// SPDX-License-Identifier: Apache-2.0
#include "nef/sphere_map/label_function.h"

#include <utility>

namespace nef {

LabelFunction::LabelFunction(std::size_t size_a, std::size_t size_b, std::function<LabelId(LabelId, LabelId)> f)
    : size_b_(size_b), f_(std::move(f)) {
  constexpr std::size_t kLargestTable = std::size_t{1} << 16U;
  if (size_a > kLargestTable / size_b) return;
  table_ = std::vector<std::atomic<std::uint32_t>>(size_a * size_b);
  for (std::atomic<std::uint32_t>& value : table_) value.store(kUnknown, std::memory_order_relaxed);
}

LabelId LabelFunction::ask(LabelId a, LabelId b) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!table_.empty()) {
    std::atomic<std::uint32_t>& value = table_[a * size_b_ + b];
    // Another thread may have asked in the meantime.
    if (value.load(std::memory_order_relaxed) == kUnknown) value.store(f_(a, b), std::memory_order_relaxed);
    return static_cast<LabelId>(value.load(std::memory_order_relaxed));
  }
  const std::uint32_t pair = static_cast<std::uint32_t>(a) << 16U | b;
  const auto known = map_.find(pair);
  return known != map_.end() ? known->second : map_.emplace(pair, f_(a, b)).first->second;
}

}  // namespace nef
