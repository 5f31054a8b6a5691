// SPDX-License-Identifier: Apache-2.0
#include "nef/number/integer_rows.h"

#include <algorithm>

#include "nef/base/error.h"

namespace nef {
namespace {

// Room for that many more at once: a table of one row, as queries make, allocates once.
template <typename T>
void make_room(std::vector<T>& values, std::size_t more) {
  if (values.capacity() - values.size() < more) {
    values.reserve(std::max(2 * values.capacity(), values.size() + more));
  }
}

}  // namespace

std::uint32_t IntegerRows::push(std::span<const mpz_srcptr> row) {
  NEF_ASSERT(row.size() == width_);
  const auto index = static_cast<std::uint32_t>(size());
  std::size_t total = 0;
  for (const mpz_srcptr value : row) total += mpz_size(value);
  make_room(limbs_, total);
  make_room(sizes_, width_);
  for (const mpz_srcptr value : row) {
    const std::size_t limbs = mpz_size(value);
    const mp_limb_t* data = mpz_limbs_read(value);
    for (std::size_t i = 0; i < limbs; ++i) limbs_.push_back(data[i]);  // one or two as a rule
    const auto signed_size = static_cast<std::int32_t>(limbs);
    sizes_.push_back(mpz_sgn(value) < 0 ? -signed_size : signed_size);
  }
  begin_.push_back(limbs_.size());
  return index;
}

std::uint32_t IntegerRows::push_from(const IntegerRows& other, std::uint32_t index) {
  NEF_ASSERT(other.width_ == width_ && &other != this);
  const auto result = static_cast<std::uint32_t>(size());
  const auto first = other.limbs_.begin() + static_cast<std::ptrdiff_t>(other.begin_[index]);
  const auto last = other.limbs_.begin() + static_cast<std::ptrdiff_t>(other.begin_[index + 1]);
  limbs_.insert(limbs_.end(), first, last);
  const auto sizes = other.sizes_.begin() + static_cast<std::ptrdiff_t>(index * width_);
  sizes_.insert(sizes_.end(), sizes, sizes + static_cast<std::ptrdiff_t>(width_));
  begin_.push_back(limbs_.size());
  return result;
}

void IntegerRows::append(const IntegerRows& other) {
  NEF_ASSERT(other.width_ == width_);
  const std::uint64_t base = limbs_.size();
  limbs_.insert(limbs_.end(), other.limbs_.begin(), other.limbs_.end());
  sizes_.insert(sizes_.end(), other.sizes_.begin(), other.sizes_.end());
  begin_.reserve(begin_.size() + other.size());
  for (std::size_t row = 1; row < other.begin_.size(); ++row) begin_.push_back(base + other.begin_[row]);
}

bool IntegerRows::equal(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const {
  const auto width = static_cast<std::ptrdiff_t>(width_);
  const auto sizes = sizes_.begin() + static_cast<std::ptrdiff_t>(row) * width;
  if (!std::equal(sizes, sizes + width, other.sizes_.begin() + static_cast<std::ptrdiff_t>(other_row) * width)) {
    return false;
  }
  return std::equal(limbs_.begin() + static_cast<std::ptrdiff_t>(begin_[row]),
                    limbs_.begin() + static_cast<std::ptrdiff_t>(begin_[row + 1]),
                    other.limbs_.begin() + static_cast<std::ptrdiff_t>(other.begin_[other_row]));
}

std::uint64_t IntegerRows::hash(std::uint32_t row) const {
  std::uint64_t h = 0x9e3779b97f4a7c15ULL;
  const auto mix = [&h](std::uint64_t value) {
    h = (h ^ value) * 0xff51afd7ed558ccdULL;
    h ^= h >> 32;
  };
  for (std::size_t i = begin_[row]; i < begin_[row + 1]; ++i) mix(limbs_[i]);
  for (std::size_t i = 0; i < width_; ++i) mix(static_cast<std::uint64_t>(sizes_[row * width_ + i]));
  return h;
}

void IntegerRows::pop() {
  begin_.pop_back();
  limbs_.resize(begin_.back());
  sizes_.resize(sizes_.size() - width_);
}

std::size_t IntegerRows::bytes() const {
  return limbs_.capacity() * sizeof(mp_limb_t) + begin_.capacity() * sizeof(std::uint64_t) +
         sizes_.capacity() * sizeof(std::int32_t);
}

void IntegerRows::reserve(std::size_t rows, std::size_t limbs_per_row) {
  limbs_.reserve(rows * limbs_per_row);
  begin_.reserve(rows + 1);
  sizes_.reserve(rows * width_);
}

}  // namespace nef
