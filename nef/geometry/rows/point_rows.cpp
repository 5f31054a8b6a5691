// SPDX-License-Identifier: Apache-2.0
//
// Why the doubles of a short row tell its integers: the double of x / w is x / w (1 + e) with |e| <= 2^-53, and so is
// its product with w, so that this is off from x by less than 2^-51.9 |x|, and rounding x + 1/2 adds no more: for |x|
// up to 2^50, less than a half in all. If w is a power of two, nothing is rounded at all.
#include "nef/geometry/rows/point_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "nef/base/capacity.h"
#include "nef/number/approximation.h"

namespace nef {
namespace {

constexpr Int128 kExactDouble = Int128{1} << 53U;
constexpr Int128 kRoundedBack = Int128{1} << 50U;

}  // namespace

// The code of a denominator, or kLong. Points of one kind follow each other, so the last ones are looked at first.
PointRows::Code PointRows::code_of(std::int64_t denominator) {
  if (is_power_of_two(denominator)) {
    return static_cast<Code>(std::countr_zero(static_cast<std::uint64_t>(denominator)));
  }
  if (!code_.empty()) {
    const Code last = code_.back();
    if (last >= kListed && last != kLong && listed_[last - kListed] == denominator) return last;
  }
  constexpr std::size_t kMost = 64;  // a search through them takes no longer than to push a row of integers
  static_assert(kListed + kMost < kLong);
  const auto found = std::find(listed_.begin(), listed_.end(), denominator);
  if (found == listed_.end()) {
    if (listed_.size() == kMost) return kLong;
    listed_.push_back(denominator);
    return static_cast<Code>(kListed + listed_.size() - 1);
  }
  return static_cast<Code>(kListed + (found - listed_.begin()));
}

bool PointRows::push_short(const std::array<Int128, 7>& row) {
  if (row[4] != 0 || row[5] != 0 || row[6] != 0 || row[3] > kExactDouble) return false;
  const auto w = static_cast<std::int64_t>(row[3]);
  const Int128 limit = is_power_of_two(w) ? kExactDouble : kRoundedBack;
  if (std::any_of(row.begin(), row.begin() + 3, [limit](Int128 x) { return x > limit || x < -limit; })) return false;
  const Code code = code_of(w);
  if (code == kLong) return false;
  const auto quotient = [&](std::size_t i) {
    return static_cast<double>(static_cast<std::int64_t>(row[i])) / static_cast<double>(w);
  };
  add(code, {quotient(0), quotient(1), quotient(2)});
  return true;
}

void PointRows::add(Code code, const Doubles& doubles) {
  approximate_.push_back(doubles);
  code_.push_back(code);
  long_.push_back(code == kLong);
}

// The last one of the long rows; of integers that are doubles themselves, the nearest doubles.
void PointRows::add_long() {
  const auto row = static_cast<std::uint32_t>(long_rows_.size() - 1);
  Doubles doubles{};
  if (std::array<std::int64_t, 7> h{}; long_rows_.are_doubles(row) && long_rows_.read_small(row, h)) {
    for (std::size_t i = 0; i < 3; ++i) doubles[i] = static_cast<double>(h[i]) / static_cast<double>(h[3]);
  } else {
    const IntegerView w = long_rows_.at(row, 3);
    for (std::size_t i = 0; i < 3; ++i) doubles[i] = approximate_quotient(long_rows_.at(row, i), w);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (const int at_infinity = long_rows_.sign(row, 4 + i)) doubles[i] = at_infinity * HUGE_VAL;
  }
  add(kLong, doubles);
}

void PointRows::push(const std::array<Int128, 7>& row) {
  if (push_short(row)) return;
  long_rows_.push(row);
  add_long();
}

void PointRows::push(const std::array<mpz_srcptr, 7>& row) {
  static_assert(GMP_NUMB_BITS == 64);
  const auto is_word = [](mpz_srcptr x) { return mpz_size(x) <= 1 && mpz_getlimbn(x, 0) >> 62U == 0; };
  if (std::all_of(row.begin(), row.end(), is_word)) {
    std::array<Int128, 7> words;
    for (std::size_t i = 0; i < 7; ++i) words[i] = mpz_sgn(row[i]) * static_cast<Int128>(mpz_getlimbn(row[i], 0));
    if (push_short(words)) return;
  }
  long_rows_.push(row);
  add_long();
}

void PointRows::push_from(const PointRows& other, std::uint32_t row) {
  Code code = other.code_[row];
  if (code >= kListed && code != kLong) {
    code = code_of(other.denominator(row));
    if (code == kLong) {
      std::array<std::int64_t, 7> h{};
      static_cast<void>(other.read_small(row, h));
      std::array<Int128, 7> words;
      std::copy(h.begin(), h.end(), words.begin());
      long_rows_.push(words);
    }
  } else if (code == kLong) {
    long_rows_.push_from(other.long_rows_, other.rank(row));
  }
  add(code, other.approximate_[row]);
}

void PointRows::append(const PointRows& other, std::size_t first, std::size_t count) {
  if (!other.listed_.empty() && !listed_.empty() && listed_ != other.listed_) {
    for (std::size_t row = first; row < first + count; ++row) push_from(other, static_cast<std::uint32_t>(row));
    return;
  }
  if (!other.listed_.empty()) listed_ = other.listed_;
  const auto copy = [&](auto& to, const auto& from) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  copy(approximate_, other.approximate_);
  copy(code_, other.code_);
  long_.append(other.long_, first, count);
  const std::size_t first_long = other.long_.rank(first);
  long_rows_.append(other.long_rows_, first_long, other.long_.rank(first + count) - first_long);
}

void PointRows::pop() {
  if (code_.back() == kLong) long_rows_.pop();
  approximate_.pop_back();
  code_.pop_back();
  long_.pop_back();
}

bool PointRows::equal(std::uint32_t row, const PointRows& other, std::uint32_t other_row) const {
  const bool both_short = is_short(row) && other.is_short(other_row);
  if (both_short) {
    return denominator(row) == other.denominator(other_row) && approximate_[row] == other.approximate_[other_row];
  }
  if (!is_short(row) && !other.is_short(other_row)) {
    return long_rows_.equal(rank(row), other.long_rows_, other.rank(other_row));
  }
  std::array<std::int64_t, 7> mine{};
  std::array<std::int64_t, 7> others{};
  return read_small(row, mine) && other.read_small(other_row, others) && mine == others;
}

std::uint64_t PointRows::hash(std::uint32_t row) const {
  if (!is_short(row)) return long_rows_.hash(rank(row));
  std::array<std::int64_t, 7> h{};
  static_cast<void>(read_small(row, h));
  return IntegerRows::hash_of(h);
}

std::size_t PointRows::bytes() const {
  return held_bytes(approximate_) + held_bytes(code_) + long_.bytes() + long_rows_.bytes() + held_bytes(listed_);
}

void PointRows::reserve(std::size_t rows, std::size_t limbs) {
  approximate_.reserve(rows);
  code_.reserve(rows);
  long_.reserve(rows);
  constexpr std::size_t kFewest = 4;  // of a long row, as a rule
  const std::size_t long_rows = std::min(rows, limbs / kFewest);
  if (long_rows > 0) long_rows_.reserve(long_rows, limbs / long_rows);
}

void PointRows::trim() {
  trim_capacity(approximate_);
  trim_capacity(code_);
  long_.trim();
  long_rows_.trim();
  trim_capacity(listed_);
}

}  // namespace nef
