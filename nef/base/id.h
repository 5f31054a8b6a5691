// SPDX-License-Identifier: Apache-2.0
//
// Typed 32-bit indices and arrays that take no others. Every element of the library is an index into a flat array of
// the object that owns it; an index means nothing without that object. All of this compiles to bare numbers and arrays.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace nef {

/// No index, where indices are bare numbers.
inline constexpr std::uint32_t kNone = 0xffffffffU;

/// A 32-bit index that cannot be mixed up with an index of another kind, or with a number. `Tag` is never defined.
template <typename Tag>
class Id {
 public:
  static constexpr std::uint32_t kNone = nef::kNone;

  /// No index.
  constexpr Id() = default;
  template <std::integral Number>
  constexpr explicit Id(Number index) : index_(static_cast<std::uint32_t>(index)) {}

  /// The bare number; kNone if there is none.
  [[nodiscard]] constexpr std::uint32_t index() const { return index_; }
  [[nodiscard]] constexpr bool valid() const { return index_ != kNone; }

  /// The index after this one.
  [[nodiscard]] constexpr Id next() const { return Id{index_ + 1U}; }
  constexpr Id& operator++() {
    ++index_;
    return *this;
  }

  /// The index n after a; how far b is before a. Modulo 2^32, so that shifts may go down.
  friend constexpr Id operator+(Id a, std::uint32_t n) { return Id{a.index_ + n}; }
  friend constexpr std::uint32_t operator-(Id a, Id b) { return a.index_ - b.index_; }
  constexpr Id& operator+=(std::uint32_t n) {
    index_ += n;
    return *this;
  }

  // One by one: g++ 12 makes more than one instruction of a < b where only <=> is there.
  friend constexpr bool operator==(Id a, Id b) { return a.index_ == b.index_; }
  friend constexpr bool operator<(Id a, Id b) { return a.index_ < b.index_; }
  friend constexpr bool operator>(Id a, Id b) { return a.index_ > b.index_; }
  friend constexpr bool operator<=(Id a, Id b) { return a.index_ <= b.index_; }
  friend constexpr bool operator>=(Id a, Id b) { return a.index_ >= b.index_; }
  friend constexpr std::strong_ordering operator<=>(Id a, Id b) { return a.index_ <=> b.index_; }

 private:
  std::uint32_t index_ = kNone;
};

/// Consecutive indices.
template <typename I>
class IdRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = I;
    using difference_type = std::ptrdiff_t;
    using pointer = const I*;
    using reference = I;

    Iterator() = default;
    explicit Iterator(I at) : at_(at) {}
    I operator*() const { return at_; }
    I operator[](difference_type n) const { return *(*this + n); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++at_;
      return before;
    }
    Iterator& operator--() { return *this += -1; }
    Iterator operator--(int) {
      const Iterator before = *this;
      *this += -1;
      return before;
    }
    Iterator& operator+=(difference_type n) {
      at_ = I{static_cast<std::uint32_t>(at_.index() + n)};
      return *this;
    }
    Iterator& operator-=(difference_type n) { return *this += -n; }
    friend Iterator operator+(Iterator i, difference_type n) { return i += n; }
    friend Iterator operator+(difference_type n, Iterator i) { return i += n; }
    friend Iterator operator-(Iterator i, difference_type n) { return i += -n; }
    friend difference_type operator-(Iterator a, Iterator b) {
      return static_cast<difference_type>(a.at_.index()) - static_cast<difference_type>(b.at_.index());
    }
    friend bool operator==(Iterator a, Iterator b) { return a.at_ == b.at_; }
    friend auto operator<=>(Iterator a, Iterator b) { return a.at_ <=> b.at_; }

   private:
    I at_;
  };

  /// Nothing.
  constexpr IdRange() = default;
  /// From `first` to before `end`.
  constexpr IdRange(I first, I end) : first_(first), end_(end) {}
  /// `count` of them, from `first` on.
  constexpr IdRange(I first, std::uint32_t count) : first_(first), end_(first.index() + count) {}

  [[nodiscard]] Iterator begin() const { return Iterator(first_); }
  [[nodiscard]] Iterator end() const { return Iterator(end_); }
  [[nodiscard]] constexpr std::uint32_t size() const { return end_.index() - first_.index(); }
  [[nodiscard]] constexpr bool empty() const { return first_ == end_; }
  [[nodiscard]] constexpr I front() const { return first_; }
  [[nodiscard]] constexpr I end_id() const { return end_; }
  [[nodiscard]] constexpr I operator[](std::uint32_t position) const { return I{first_.index() + position}; }
  /// The inverse of [].
  [[nodiscard]] constexpr std::uint32_t position(I id) const { return id.index() - first_.index(); }
  [[nodiscard]] constexpr bool contains(I id) const { return id >= first_ && id < end_; }

 private:
  I first_{0};
  I end_{0};
};

/// A std::vector that is indexed by one kind of index only. T may be bool, as in std::vector.
template <typename I, typename T>
class IndexedVector {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;
  using reference = typename std::vector<T>::reference;
  using const_reference = typename std::vector<T>::const_reference;

  IndexedVector() = default;
  explicit IndexedVector(std::size_t size) : values_(size) {}
  IndexedVector(std::size_t size, const T& value) : values_(size, value) {}
  IndexedVector(std::initializer_list<T> values) : values_(values) {}
  explicit IndexedVector(std::vector<T>&& values) : values_(std::move(values)) {}

  [[nodiscard]] reference operator[](I id) { return values_[id.index()]; }
  [[nodiscard]] const_reference operator[](I id) const { return values_[id.index()]; }
  /// The values of consecutive indices.
  [[nodiscard]] std::span<const T> operator[](IdRange<I> range) const {
    return {values_.data() + range.front().index(), range.size()};
  }
  [[nodiscard]] std::span<T> operator[](IdRange<I> range) {
    return {values_.data() + range.front().index(), range.size()};
  }

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  /// All indices.
  [[nodiscard]] IdRange<I> ids() const { return {I{0}, end_id()}; }
  /// The index after the last one: the next that push_back gives.
  [[nodiscard]] I end_id() const { return I{values_.size()}; }

  [[nodiscard]] bool contains(I id) const { return id.index() < values_.size(); }

  [[nodiscard]] T* data() { return values_.data(); }
  [[nodiscard]] const T* data() const { return values_.data(); }

  /// The index of the new value.
  I push_back(const T& value) {
    values_.push_back(value);
    return I{values_.size() - 1};
  }
  void resize(std::size_t size) { values_.resize(size); }
  void resize(std::size_t size, const T& value) { values_.resize(size, value); }
  void assign(std::size_t size, const T& value) { values_.assign(size, value); }
  void reserve(std::size_t size) { values_.reserve(size); }
  void shrink_to_fit() { values_.shrink_to_fit(); }
  void clear() { values_.clear(); }
  [[nodiscard]] std::size_t capacity() const { return values_.capacity(); }

  [[nodiscard]] iterator begin() { return values_.begin(); }
  [[nodiscard]] iterator end() { return values_.end(); }
  [[nodiscard]] const_iterator begin() const { return values_.begin(); }
  [[nodiscard]] const_iterator end() const { return values_.end(); }
  [[nodiscard]] const_reference front() const { return values_.front(); }
  [[nodiscard]] reference back() { return values_.back(); }
  [[nodiscard]] const_reference back() const { return values_.back(); }

  /// The values without their indices.
  [[nodiscard]] std::vector<T>& values() { return values_; }
  [[nodiscard]] const std::vector<T>& values() const { return values_; }

  friend bool operator==(const IndexedVector&, const IndexedVector&) = default;

 private:
  std::vector<T> values_;
};

}  // namespace nef

template <typename Tag>
struct std::hash<nef::Id<Tag>> {
  std::size_t operator()(nef::Id<Tag> id) const { return id.index(); }
};
