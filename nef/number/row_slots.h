// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nef {

/// Finds rows of a table (with hash and equal as IntegerRows has them) by what they hold: a hash table with open
/// addressing, at most half full, beside the rows, which are passed in. Several threads may look rows up at once while
/// nothing is added.
class RowSlots {
 public:
  struct Slot {
    std::uint32_t row;
    std::uint32_t hash;
    [[nodiscard]] bool empty() const { return row == kEmpty; }
  };

  template <typename Rows>
  static std::uint32_t hash_of(const Rows& rows, std::uint32_t row) {
    const std::uint64_t hash = rows.hash(row);
    return static_cast<std::uint32_t>(hash ^ hash >> 32U);
  }

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }
  /// Gives its memory back.
  void clear() { slots_ = std::vector<Slot>(); }

  /// Makes room for so many rows altogether; those that were added stay.
  void reserve(std::size_t rows) {
    const std::size_t capacity = std::bit_ceil(std::max<std::size_t>(16, 2 * rows));
    if (capacity <= slots_.size()) return;
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(capacity, {kEmpty, 0}));
    for (const Slot& slot : old) {
      if (!slot.empty()) add_new(slot.row, slot.hash);
    }
  }

  /// Adds a row that equals none of those here. There must be room.
  void add_new(std::uint32_t row, std::uint32_t hash) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (!slots_[at].empty()) at = (at + 1) & mask;
    slots_[at] = {row, hash};
  }

  /// Has the place fetched where rows of this hash are looked for. There must be room.
  void prefetch(std::uint32_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }

  /// The slot of the row of `rows` that equals a row of `other`, or the empty one where it belongs.
  template <typename Rows>
  [[nodiscard]] const Slot& find(const Rows& rows, std::uint32_t hash, const Rows& other,
                                 std::uint32_t other_row) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (!slots_[at].empty() && (slots_[at].hash != hash || !rows.equal(slots_[at].row, other, other_row))) {
      at = (at + 1) & mask;
    }
    return slots_[at];
  }
  template <typename Rows>
  [[nodiscard]] Slot& find(const Rows& rows, std::uint32_t hash, const Rows& other, std::uint32_t other_row) {
    return const_cast<Slot&>(std::as_const(*this).find(rows, hash, other, other_row));
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  std::vector<Slot> slots_;
};

}  // namespace nef
