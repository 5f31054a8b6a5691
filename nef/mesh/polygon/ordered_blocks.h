// SPDX-License-Identifier: Apache-2.0
//
// A list of numbers in an order that only predicates know.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace nef {

/// Distinct small numbers in an order, in blocks of so many that lie side by side in memory: a search asks O(log n)
/// questions; to insert and to erase moves what is in a block, and once in half a block of times the list of blocks.
class OrderedBlocks {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Between two neighbours. Valid until the list changes.
  struct Place {
    std::size_t block = 0;  // in the list of blocks
    std::size_t at = 0;
  };

  void clear() {
    blocks_.clear();
    order_.clear();
    free_.clear();
    block_of_.clear();
    size_ = 0;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The place behind the last item for which is_below(item) holds; it must hold for all items before one for which it
  /// does.
  template <typename IsBelow>
  [[nodiscard]] Place find(IsBelow&& is_below) const {
    if (order_.empty()) return {};
    const auto first = std::partition_point(order_.begin() + 1, order_.end(),
                                            [&](std::uint32_t block) { return is_below(blocks_[block].items[0]); });
    const auto k = static_cast<std::size_t>(first - order_.begin()) - 1;
    const Block& block = blocks_[order_[k]];
    const auto at = std::partition_point(block.items.begin(), block.items.begin() + block.count, is_below);
    return {k, static_cast<std::size_t>(at - block.items.begin())};
  }

  /// The item before a place; kNone if there is none.
  [[nodiscard]] std::uint32_t before(const Place& place) const {
    return place.at == 0 ? kNone : blocks_[order_[place.block]].items[place.at - 1];
  }

  void insert(Place place, std::uint32_t item) {
    if (order_.empty()) order_.push_back(new_block());
    if (blocks_[order_[place.block]].count == kSize) place = part(place);
    Block& block = blocks_[order_[place.block]];
    const auto begin = block.items.begin() + static_cast<std::ptrdiff_t>(place.at);
    std::copy_backward(begin, block.items.begin() + block.count, block.items.begin() + block.count + 1);
    *begin = item;
    ++block.count;
    ++size_;
    if (item >= block_of_.size()) block_of_.resize(item + 1);
    block_of_[item] = order_[place.block];
  }

  void erase(std::uint32_t item) {
    const std::uint32_t id = block_of_[item];
    Block& block = blocks_[id];
    const auto end = block.items.begin() + block.count;
    const auto at = std::find(block.items.begin(), end, item);
    std::copy(at + 1, end, at);
    --size_;
    if (--block.count > 0) return;
    order_.erase(std::find(order_.begin(), order_.end(), id));
    free_.push_back(id);
  }

 private:
  static constexpr std::uint32_t kSize = 128;
  struct Block {
    std::uint32_t count = 0;
    std::array<std::uint32_t, kSize> items;
  };

  std::uint32_t new_block() {
    if (free_.empty()) {
      blocks_.emplace_back();
      return static_cast<std::uint32_t>(blocks_.size() - 1);
    }
    const std::uint32_t id = free_.back();
    free_.pop_back();
    return id;
  }

  // Moves the second half of a full block to one of its own.
  Place part(const Place& place) {
    const std::uint32_t id = new_block();
    Block& whole = blocks_[order_[place.block]];
    Block& half = blocks_[id];
    whole.count = half.count = kSize / 2;
    std::copy(whole.items.begin() + kSize / 2, whole.items.end(), half.items.begin());
    for (std::uint32_t i = 0; i < half.count; ++i) block_of_[half.items[i]] = id;
    order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(place.block) + 1, id);
    if (place.at <= kSize / 2) return place;
    return {place.block + 1, place.at - kSize / 2};
  }

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> order_;     // blocks that are not empty
  std::vector<std::uint32_t> free_;      // and those that are
  std::vector<std::uint32_t> block_of_;  // of each item
  std::size_t size_ = 0;
};

}  // namespace nef
