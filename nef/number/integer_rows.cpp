// SPDX-License-Identifier: Apache-2.0
//
// The limbs of all integers stand one after another, and each integer has a signed count of its limbs in one byte (in
// four once a number needs more than 127). Where a row begins is noted for every fourth row; the counts between lead to
// the others, eight at a time by arithmetic on bytes. So an integer of one limb takes nine bytes and a zero takes one.
#include "nef/number/integer_rows.h"

#include <algorithm>
#include <array>
#include <limits>

#include "nef/base/capacity.h"
#include "nef/base/error.h"

namespace nef {
namespace {

constexpr std::size_t kMostShort = 9;  // entries of a row of two words each

constexpr std::uint64_t kHashOfNothing = 0x9e3779b97f4a7c15ULL;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0xff51afd7ed558ccdULL;
  return hash ^ hash >> 32;
}

// Room for that many more at once: a table of one row, as queries make, allocates once.
template <typename T>
void make_room(std::vector<T>& values, std::size_t more) {
  if (values.capacity() - values.size() < more) {
    values.reserve(std::max(2 * values.capacity(), values.size() + more));
  }
}

}  // namespace

void IntegerRows::widen() {
  is_wide_ = true;
  wide_.reserve(sizes_.capacity());
  wide_.assign(sizes_.begin() + kPadding, sizes_.end());
  sizes_ = std::vector<std::int8_t>();
}

void IntegerRows::push_size(std::int32_t size) {
  if (!is_wide_ && (size < -127 || size > 127)) widen();
  if (is_wide_) {
    wide_.push_back(size);
  } else {
    sizes_.push_back(static_cast<std::int8_t>(size));
  }
}

void IntegerRows::append_sizes(const IntegerRows& other, std::size_t first, std::size_t last) {
  if (other.is_wide_ || is_wide_) {
    for (std::size_t i = first; i < last; ++i) push_size(other.size(i));
    return;
  }
  const auto from = other.sizes_.begin() + kPadding;
  sizes_.insert(sizes_.end(), from + static_cast<std::ptrdiff_t>(first), from + static_cast<std::ptrdiff_t>(last));
}

// Makes room for a row of so many limbs.
void IntegerRows::begin_row(std::size_t limbs) {
  make_room(limbs_, limbs);
  if (begin_.empty()) {
    begin_.push_back(0);
    make_room(sizes_, kPadding + width_);
    sizes_.assign(kPadding, 0);
  }
  if (!is_wide_) make_room(sizes_, width_);
}

void IntegerRows::end_row() {
  if (limbs_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw UnsupportedError("the set needs more than 32 GB of coordinates; use fewer or shorter ones");
  }
  if (++size_ % kTogether == 0) begin_.push_back(static_cast<std::uint32_t>(limbs_.size()));
}

std::uint32_t IntegerRows::push(std::span<const mpz_srcptr> row) {
  NEF_ASSERT(row.size() == width_);
  const auto index = static_cast<std::uint32_t>(size());
  std::size_t total = 0;
  for (const mpz_srcptr value : row) total += mpz_size(value);
  begin_row(total);
  for (const mpz_srcptr value : row) {
    const std::size_t limbs = mpz_size(value);
    const mp_limb_t* data = mpz_limbs_read(value);
    for (std::size_t i = 0; i < limbs; ++i) limbs_.push_back(data[i]);  // one or two as a rule
    const auto signed_size = static_cast<std::int32_t>(limbs);
    push_size(mpz_sgn(value) < 0 ? -signed_size : signed_size);
  }
  end_row();
  return index;
}

std::uint32_t IntegerRows::push(std::span<const Int128> row) {
  NEF_ASSERT(row.size() == width_ && width_ <= kMostShort);
  static_assert(GMP_NUMB_BITS == 64);
  const auto index = static_cast<std::uint32_t>(size());
  std::array<mp_limb_t, 2 * kMostShort> limbs;  // set as far as there are limbs
  std::array<std::int8_t, kMostShort> sizes;
  std::size_t end = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Unsigned128 size = magnitude(row[i]);
    const auto low = static_cast<mp_limb_t>(size);
    const auto high = static_cast<mp_limb_t>(size >> 64U);
    limbs[end] = low;
    limbs[end + 1] = high;
    const int count = static_cast<int>(high != 0) + static_cast<int>((low | high) != 0);  // without branches
    sizes[i] = static_cast<std::int8_t>(row[i] < 0 ? -count : count);
    end += static_cast<std::size_t>(count);
  }
  begin_row(end);
  limbs_.insert(limbs_.end(), limbs.begin(), limbs.begin() + static_cast<std::ptrdiff_t>(end));
  const auto last_size = sizes.begin() + static_cast<std::ptrdiff_t>(width_);
  if (is_wide_) {
    wide_.insert(wide_.end(), sizes.begin(), last_size);
  } else {
    sizes_.insert(sizes_.end(), sizes.begin(), last_size);
  }
  end_row();
  return index;
}

std::uint32_t IntegerRows::push_from(const IntegerRows& other, std::uint32_t index) {
  NEF_ASSERT(other.width_ == width_ && &other != this);
  const auto result = static_cast<std::uint32_t>(size());
  const std::span<const mp_limb_t> limbs = other.limbs_of(index);
  begin_row(limbs.size());
  for (const mp_limb_t limb : limbs) limbs_.push_back(limb);  // few as a rule
  append_sizes(other, index * width_, (index + std::size_t{1}) * width_);
  end_row();
  return result;
}

void IntegerRows::append(const IntegerRows& other, std::size_t first, std::size_t count) {
  NEF_ASSERT(other.width_ == width_ && &other != this);
  const std::size_t last = first + count;
  const auto limb = [&other](std::size_t row) {
    return other.limbs_.begin() + static_cast<std::ptrdiff_t>(other.begin(row));
  };
  if (count == 0) return;
  begin_row(0);
  const std::size_t base = limbs_.size() - other.begin(first);  // modulo 2^64
  limbs_.insert(limbs_.end(), limb(first), limb(last));
  append_sizes(other, first * width_, last * width_);
  for (std::size_t row = size_ + kTogether - size_ % kTogether; row < size_ + count; row += kTogether) {
    begin_.push_back(static_cast<std::uint32_t>(base + other.begin(first + row - size_)));
  }
  size_ += count - 1;
  end_row();
}

bool IntegerRows::are_doubles(std::uint32_t row) const {
  if (is_wide_) return false;
  constexpr mp_limb_t kLimit = mp_limb_t{1} << 53U;
  const std::int8_t* const sizes = sizes_.data() + kPadding + row * width_;
  const auto one_limb = [](std::int8_t size) { return size >= -1 && size <= 1; };
  const std::span<const mp_limb_t> limbs = limbs_of(row);
  return std::all_of(sizes, sizes + width_, one_limb) &&
         std::all_of(limbs.begin(), limbs.end(), [](mp_limb_t limb) { return limb <= kLimit; });
}

// Loops without branches, for vector instructions.
bool IntegerRows::all_are_doubles() const {
  if (is_wide_) return false;
  constexpr mp_limb_t kLimit = mp_limb_t{1} << 53U;
  mp_limb_t bits = 0;
  for (const mp_limb_t limb : limbs_) bits |= limb;
  std::uint8_t largest = 0;  // of sizes plus one
  for (const std::int8_t size : sizes_) largest = std::max(largest, static_cast<std::uint8_t>(size + 1));
  return bits < kLimit && largest <= 2;
}

bool IntegerRows::same_sizes(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const {
  const std::size_t mine = row * width_;
  const std::size_t others = other_row * width_;
  for (std::size_t i = 0; i < width_; ++i) {
    if (size(mine + i) != other.size(others + i)) return false;
  }
  return true;
}

bool IntegerRows::equal(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const {
  if (!same_sizes(row, other, other_row)) return false;
  const std::span<const mp_limb_t> limbs = limbs_of(row);
  return std::equal(limbs.begin(), limbs.end(),
                    other.limbs_.begin() + static_cast<std::ptrdiff_t>(other.begin(other_row)));
}

std::uint64_t IntegerRows::hash_of(std::span<const std::int64_t> row) {
  std::uint64_t h = kHashOfNothing;
  std::uint64_t sizes = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0) continue;
    h = mixed(h, static_cast<std::uint64_t>(std::abs(row[i])));
    sizes |= std::uint64_t{row[i] < 0 ? 0xFFU : 1U} << (8 * i);
  }
  return mixed(h, sizes);
}

std::uint64_t IntegerRows::hash(std::uint32_t row) const {
  std::uint64_t h = kHashOfNothing;
  for (const mp_limb_t limb : limbs_of(row)) h = mixed(h, limb);
  std::uint64_t sizes = 0;  // a byte of each, which is all of it but for giants and for the last ones of wide rows
  if (std::endian::native == std::endian::little && !is_wide_ && width_ <= kPadding) {
    std::memcpy(&sizes, &sizes_[(row + std::size_t{1}) * width_], kPadding);  // ends where the row does
    sizes >>= 8 * (kPadding - width_);
  } else {
    for (std::size_t i = width_; i-- > 0;) sizes = sizes << 8U | static_cast<std::uint8_t>(size(row * width_ + i));
  }
  return mixed(h, sizes);
}

void IntegerRows::pop() {
  limbs_.resize(begin(size_ - 1));
  if (size_-- % kTogether == 0) begin_.pop_back();
  if (is_wide_) {
    wide_.resize(wide_.size() - width_);
  } else {
    sizes_.resize(sizes_.size() - width_);
  }
}

void IntegerRows::keep(std::span<const std::uint8_t> used) {
  NEF_ASSERT(used.size() == size_);
  if (size_ == 0) return;
  std::size_t from = 0;  // limb
  std::size_t to = 0;
  std::size_t kept = 0;
  const auto move_sizes = [&](auto first, std::size_t row) {
    const auto begin = first + static_cast<std::ptrdiff_t>(row * width_);
    std::copy(begin, begin + static_cast<std::ptrdiff_t>(width_), first + static_cast<std::ptrdiff_t>(kept * width_));
  };
  for (std::size_t row = 0; row < size_; ++row) {
    const std::size_t limbs = limbs_between(row * width_, (row + 1) * width_);
    if (used[row] != 0) {
      if (kept < row) {
        std::copy_n(limbs_.begin() + static_cast<std::ptrdiff_t>(from), limbs,
                    limbs_.begin() + static_cast<std::ptrdiff_t>(to));
        if (is_wide_) {
          move_sizes(wide_.begin(), row);
        } else {
          move_sizes(sizes_.begin() + kPadding, row);
        }
      }
      to += limbs;
      if (++kept % kTogether == 0) begin_[kept / kTogether] = static_cast<std::uint32_t>(to);
    }
    from += limbs;
  }
  size_ = kept;
  limbs_.resize(to);
  begin_.resize(kept / kTogether + 1);
  if (is_wide_) {
    wide_.resize(kept * width_);
  } else {
    sizes_.resize(kPadding + kept * width_);
  }
}

std::size_t IntegerRows::bytes() const {
  return held_bytes(limbs_) + held_bytes(begin_) + held_bytes(sizes_) + held_bytes(wide_);
}

void IntegerRows::reserve(std::size_t rows, std::size_t limbs_per_row) {
  limbs_.reserve(rows * limbs_per_row);
  begin_.reserve(rows / kTogether + 1);
  if (!is_wide_) sizes_.reserve(kPadding + rows * width_);
}

void IntegerRows::trim() {
  trim_capacity(limbs_);
  trim_capacity(begin_);
  trim_capacity(sizes_);
  trim_capacity(wide_);
}

}  // namespace nef
