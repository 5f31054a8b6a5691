// SPDX-License-Identifier: Apache-2.0
//
// A row is looked at once, when it is pushed: whether its normal is one of doubles and its offset short enough. If not,
// it goes into the table of long rows, with doubles made of its leading bits in the same way.
#include "nef/geometry/rows/plane_rows.h"

#include <algorithm>
#include <limits>

#include "nef/base/capacity.h"

namespace nef {
namespace {

// value / 2^top in doubles, cut off after 53 bits, which is within 2^-52: the bits that count, times a power of two.
double scaled(Int128 value, int top) {
  const Unsigned128 size = magnitude(value);
  const int dropped = std::max(0, bit_width(size) - 53);
  const auto bits = static_cast<double>(static_cast<std::int64_t>(size >> dropped));
  const auto power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + dropped - top) << 52U);
  return value < 0 ? -bits * power : bits * power;
}

// The number of bits of an integer that is not 0.
long bits_of(mpz_srcptr value) {
  const auto last = static_cast<mp_size_t>(mpz_size(value) - 1);
  return 64 * last + static_cast<long>(std::bit_width(mpz_getlimbn(value, last)));
}

// The same for any integer.
double scaled(mpz_srcptr value, long top) {
  static_assert(GMP_NUMB_BITS == 64);
  if (mpz_sgn(value) == 0) return 0.0;
  const auto last = static_cast<mp_size_t>(mpz_size(value) - 1);
  mp_limb_t bits = mpz_getlimbn(value, last);
  const int unused = std::countl_zero(bits);
  if (unused > 0) bits = bits << unused | (last > 0 ? mpz_getlimbn(value, last - 1) >> (64 - unused) : 0);
  const auto first = static_cast<double>(static_cast<std::int64_t>(bits >> 11U));  // 53 bits
  const double mantissa = mpz_sgn(value) < 0 ? -first : first;
  const long shift = 64 * (last + 1) - unused - top;  // the value is below 2^shift
  if (shift > 1023) return mantissa < 0 ? -HUGE_VAL : HUGE_VAL;
  if (shift < -1060) return 0.0;
  constexpr long kLeast = -960;  // above it neither the power of two nor the value is too small for all its bits
  if (shift < kLeast) return std::ldexp(mantissa, static_cast<int>(shift) - 53);
  return mantissa * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + shift - 53) << 52U);
}

// True if what is left of a number without the zeros at its end has 53 bits at most.
bool is_double(Int128 value) {
  const Unsigned128 size = magnitude(value);
  const int dropped = bit_width(size) - 53;
  return dropped <= 0 || (size & ((Unsigned128{1} << dropped) - 1)) == 0;
}

}  // namespace

void PlaneRows::add(std::uint8_t top, std::uint64_t low, const Doubles& doubles) {
  approximate_.push_back(doubles);
  low_.push_back(low);
  top_.push_back(top);
  long_.push_back(top == kLong);
}

// The last one of the long rows.
void PlaneRows::add_long() {
  const std::array<IntegerView, 5> row = long_rows_.first<5>(static_cast<std::uint32_t>(long_rows_.size() - 1));
  long top = std::numeric_limits<long>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    if (row[i].sign() != 0) top = std::max(top, bits_of(row[i]));
  }
  Doubles doubles{};
  for (std::size_t i = 0; i < 4; ++i) doubles[i] = scaled(row[i], top);
  if (row[4].sign() != 0) doubles[3] = row[4].sign() > 0 ? HUGE_VAL : -HUGE_VAL;
  // What is lost here may be all that matters at a point far away.
  constexpr double kLeast = 0x1p-1000;
  for (std::size_t i = 0; i < 3; ++i) {
    if (row[i].sign() != 0 && std::fabs(doubles[i]) < kLeast) doubles[3] = HUGE_VAL;
  }
  add(kLong, 0, doubles);
}

void PlaneRows::push(const std::array<Int128, 5>& row) {
  constexpr int kMostOfNormal = 126;
  constexpr int kMostOfOffset = 117;
  const int top = bit_width(magnitude(row[0]) | magnitude(row[1]) | magnitude(row[2]));
  const Unsigned128 offset = magnitude(row[3]);
  if (row[4] == 0 && top <= kMostOfNormal && bit_width(offset) <= kMostOfOffset && is_double(row[0]) &&
      is_double(row[1]) && is_double(row[2])) {
    add(static_cast<std::uint8_t>(top), static_cast<std::uint64_t>(offset),
        {scaled(row[0], top), scaled(row[1], top), scaled(row[2], top), scaled(row[3], top)});
    return;
  }
  long_rows_.push(row);
  add_long();
}

void PlaneRows::push(const std::array<mpz_srcptr, 5>& row) {
  static_assert(GMP_NUMB_BITS == 64);
  const auto is_short = [](mpz_srcptr x) { return mpz_size(x) <= 2 && mpz_getlimbn(x, 1) >> 62U == 0; };
  if (std::all_of(row.begin(), row.end(), is_short)) {
    std::array<Int128, 5> words;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto size =
          static_cast<Int128>(static_cast<Unsigned128>(mpz_getlimbn(row[i], 1)) << 64U | mpz_getlimbn(row[i], 0));
      words[i] = mpz_sgn(row[i]) < 0 ? -size : size;
    }
    push(words);
    return;
  }
  long_rows_.push(row);
  add_long();
}

void PlaneRows::push_from(const PlaneRows& other, std::uint32_t row) {
  if (!other.is_short(row)) long_rows_.push_from(other.long_rows_, other.rank(row));
  add(other.top_[row], other.low_[row], other.approximate_[row]);
}

void PlaneRows::append(const PlaneRows& other, std::size_t first, std::size_t count) {
  const auto copy = [&](auto& to, const auto& from) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  copy(approximate_, other.approximate_);
  copy(low_, other.low_);
  copy(top_, other.top_);
  long_.append(other.long_, first, count);
  const std::size_t first_long = other.long_.rank(first);
  long_rows_.append(other.long_rows_, first_long, other.long_.rank(first + count) - first_long);
}

void PlaneRows::pop() {
  if (top_.back() == kLong) long_rows_.pop();
  approximate_.pop_back();
  low_.pop_back();
  top_.pop_back();
  long_.pop_back();
}

void PlaneRows::keep(std::span<const std::uint8_t> used) {
  if (long_rows_.size() > 0) {
    std::vector<std::uint8_t> used_long;
    for (std::uint32_t row = 0; row < used.size(); ++row) {
      if (!is_short(row)) used_long.push_back(used[row]);
    }
    long_rows_.keep(used_long);
  }
  RankedBits bits;
  bits.reserve(size());
  std::size_t kept = 0;
  for (std::size_t row = 0; row < used.size(); ++row) {
    if (used[row] == 0) continue;
    approximate_[kept] = approximate_[row];
    low_[kept] = low_[row];
    top_[kept] = top_[row];
    bits.push_back(top_[kept] == kLong);
    ++kept;
  }
  approximate_.resize(kept);
  low_.resize(kept);
  top_.resize(kept);
  long_ = std::move(bits);
}

// Any that is good enough for a table of hashes, at the price of few multiplications.
std::uint64_t PlaneRows::hash(std::uint32_t row) const {
  if (!is_short(row)) return long_rows_.hash(rank(row));
  std::uint64_t h = low_[row] + top_[row];
  for (const double x : approximate_[row]) {
    h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0xff51afd7ed558ccdULL;
    h ^= h >> 32U;
  }
  return h;
}

std::size_t PlaneRows::bytes() const {
  return held_bytes(approximate_) + held_bytes(low_) + held_bytes(top_) + long_.bytes() + long_rows_.bytes();
}

void PlaneRows::reserve(std::size_t rows, std::size_t limbs) {
  approximate_.reserve(rows);
  low_.reserve(rows);
  top_.reserve(rows);
  long_.reserve(rows);
  constexpr std::size_t kFewest = 5;  // of a long row, as a rule
  const std::size_t long_rows = std::min(rows, limbs / kFewest);
  if (long_rows > 0) long_rows_.reserve(long_rows, limbs / long_rows);
}

void PlaneRows::trim() {
  trim_capacity(approximate_);
  trim_capacity(low_);
  trim_capacity(top_);
  long_.trim();
  long_rows_.trim();
}

}  // namespace nef
