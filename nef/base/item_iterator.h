// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace nef {

/// An iterator over tables that give their items away by value. Table has `value_type`, and `item(i)` for the i-th of
/// its items. The table must outlive it.
template <typename Table>
class ItemIterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = typename Table::value_type;
  using difference_type = std::ptrdiff_t;
  using pointer = const value_type*;
  using reference = value_type;

  ItemIterator() = default;
  ItemIterator(const Table& table, std::size_t at) : table_(&table), at_(static_cast<difference_type>(at)) {}

  value_type operator*() const { return table_->item(static_cast<std::size_t>(at_)); }
  value_type operator[](difference_type n) const { return table_->item(static_cast<std::size_t>(at_ + n)); }
  ItemIterator& operator++() {
    ++at_;
    return *this;
  }
  ItemIterator operator++(int) {
    const ItemIterator before = *this;
    ++at_;
    return before;
  }
  ItemIterator& operator--() {
    --at_;
    return *this;
  }
  ItemIterator& operator+=(difference_type n) {
    at_ += n;
    return *this;
  }
  friend ItemIterator operator+(ItemIterator i, difference_type n) { return i += n; }
  friend difference_type operator-(const ItemIterator& a, const ItemIterator& b) { return a.at_ - b.at_; }
  friend bool operator==(const ItemIterator& a, const ItemIterator& b) { return a.at_ == b.at_; }
  friend auto operator<=>(const ItemIterator& a, const ItemIterator& b) { return a.at_ <=> b.at_; }

 private:
  const Table* table_ = nullptr;
  difference_type at_ = 0;
};

}  // namespace nef
