// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nef/base/capacity.h"

namespace nef {

/// A list of bits that knows how many are set before each: which of some items are of a rare kind, and where in a list
/// of these each one stands. Two bits an item.
class RankedBits {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool operator[](std::size_t i) const { return (words_[i / kBits].bits >> (i % kBits) & 1U) != 0; }
  /// How many are set.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// How many are set before bit i, which may be the one after the last.
  [[nodiscard]] std::size_t rank(std::size_t i) const {
    if (i == size_) return count_;
    const Word& word = words_[i / kBits];
    // Of a word without set bits, as most are, none need be counted.
    return word.bits == 0 ? word.before : word.before + set_bits(word.bits & ((std::uint64_t{1} << (i % kBits)) - 1));
  }

  void push_back(bool bit) { push_bits(bit ? 1U : 0U, 1); }
  void pop_back() {
    --size_;
    if ((*this)[size_]) --count_;
    words_.back().bits &= ~(std::uint64_t{1} << (size_ % kBits));
    if (size_ % kBits == 0) words_.pop_back();
  }

  /// Adds bits of another list, from bit `first` on. O(count / 64).
  void append(const RankedBits& other, std::size_t first, std::size_t count) {
    while (count > 0) {
      const std::size_t some = std::min({count, kBits - size_ % kBits, kBits - first % kBits});
      push_bits(other.words_[first / kBits].bits >> (first % kBits), some);
      first += some;
      count -= some;
    }
  }

  void clear() { *this = RankedBits(); }
  void reserve(std::size_t bits) { words_.reserve((bits + kBits - 1) / kBits); }
  void trim() { trim_capacity(words_); }
  [[nodiscard]] std::size_t bytes() const { return held_bytes(words_); }

 private:
  static constexpr std::size_t kBits = 64;
  struct Word {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;  // set bits before it
  };

  // The lowest `count` of the bits, for which there is room in one word.
  void push_bits(std::uint64_t bits, std::size_t count) {
    if (size_ % kBits == 0) words_.push_back({0, static_cast<std::uint32_t>(count_)});
    if (count < kBits) bits &= (std::uint64_t{1} << count) - 1;
    words_.back().bits |= bits << (size_ % kBits);
    size_ += count;
    if (bits != 0) count_ += set_bits(bits);
  }

  // std::popcount is a call on machines of the oldest kind.
  static std::size_t set_bits(std::uint64_t word) {
    word -= word >> 1U & 0x5555555555555555U;
    word = (word & 0x3333333333333333U) + (word >> 2U & 0x3333333333333333U);
    word = (word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
    return word * 0x0101010101010101U >> 56U;
  }

  std::vector<Word> words_;
  std::size_t size_ = 0;
  std::size_t count_ = 0;
};

}  // namespace nef
