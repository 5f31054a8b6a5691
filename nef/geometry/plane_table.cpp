// SPDX-License-Identifier: Apache-2.0
//
// Coefficients are divided by their common factor and made positive in the first non-zero component of the normal, so
// equal planes have equal rows; a hash table with open addressing, at most half full, finds them. It is filled when the
// first plane is looked for, since most finished tables are only read. Tables are compared in bulk: hashes of the
// smaller table are put into slots, on several threads, and the rows of the larger one are looked up.
#include "nef/geometry/plane_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "nef/base/capacity.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/number/int128.h"

namespace nef {
namespace {

// value / 2^top in doubles, cut off after 53 bits, which is within 2^-52: the bits that count, times a power of two.
double scaled(Int128 value, long top) {
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

}  // namespace

// The candidate is the last row; keep it, with the doubles that `approximate` gives, only if no equal row exists.
template <typename Approximate>
PlaneId PlaneTable::find_or_add_last(Approximate&& approximate) {
  const auto candidate = static_cast<std::uint32_t>(rows_.size() - 1);
  make_room_for(1);
  const std::uint32_t hash = RowSlots::hash_of(rows_, candidate);
  RowSlots::Slot& slot = slots_.find(rows_, hash, rows_, candidate);
  if (!slot.empty()) {
    rows_.pop();
    return PlaneId{slot.row << 1U};
  }
  slot = {candidate, hash};
  approximate_.push_back(approximate());
  return PlaneId{candidate << 1U};
}

void PlaneTable::reserve(std::size_t planes, std::size_t limbs) {
  rows_.reserve(planes, limbs);
  approximate_.reserve(planes);
}

void PlaneTable::keep(std::span<const std::uint8_t> used) {
  slots_.clear();
  rows_.keep(used);
  std::size_t kept = 0;
  for (std::size_t row = 0; row < used.size(); ++row) {
    if (used[row] != 0) approximate_[kept++] = approximate_[row];
  }
  approximate_.resize(kept);
}

void PlaneTable::trim() {
  rows_.trim();
  trim_capacity(approximate_);
  slots_.clear();
}

PlaneId PlaneTable::intern(const Integer& a, const Integer& b, const Integer& c, const Integer& d, const Integer& e) {
  Integer divisor;
  mpz_gcd(divisor.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), c.get_mpz_t());
  NEF_ASSERT(divisor != 0);
  if (divisor != 1) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), d.get_mpz_t());
  if (divisor != 1) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), e.get_mpz_t());
  const int lead = sgn(a) != 0 ? sgn(a) : (sgn(b) != 0 ? sgn(b) : sgn(c));
  if (lead < 0) divisor = -divisor;
  if (divisor == 1) {
    const std::array<mpz_srcptr, 5> row{a.get_mpz_t(), b.get_mpz_t(), c.get_mpz_t(), d.get_mpz_t(), e.get_mpz_t()};
    rows_.push(row);
  } else {
    std::array<Integer, 5> q{a, b, c, d, e};
    for (Integer& value : q) mpz_divexact(value.get_mpz_t(), value.get_mpz_t(), divisor.get_mpz_t());
    const std::array<mpz_srcptr, 5> row{q[0].get_mpz_t(), q[1].get_mpz_t(), q[2].get_mpz_t(), q[3].get_mpz_t(),
                                        q[4].get_mpz_t()};
    rows_.push(row);
  }
  const PlaneId plane = find_or_add_last();
  return lead < 0 ? plane.opposite() : plane;
}

PlaneId PlaneTable::intern_primitive(const std::array<mpz_srcptr, 4>& plane) {
  std::size_t lead = 0;
  while (mpz_sgn(plane[lead]) == 0) ++lead;
  NEF_ASSERT(lead < 3);
  const IntegerView zero(nullptr, 0);
  const bool flip = mpz_sgn(plane[lead]) < 0;
  if (!flip) {
    const std::array<mpz_srcptr, 5> row{plane[0], plane[1], plane[2], plane[3], zero};
    rows_.push(row);
    return find_or_add_last();
  }
  // Views of the same limbs with the other sign.
  std::array<mpz_t, 4> negated;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto size = static_cast<mp_size_t>(mpz_size(plane[i]));
    mpz_roinit_n(negated[i], mpz_limbs_read(plane[i]), mpz_sgn(plane[i]) > 0 ? -size : size);
  }
  const std::array<mpz_srcptr, 5> row{negated[0], negated[1], negated[2], negated[3], zero};
  rows_.push(row);
  return find_or_add_last().opposite();
}

PlaneId PlaneTable::intern_primitive(const std::array<Int128, 5>& plane) {
  std::size_t lead = 0;
  while (plane[lead] == 0) ++lead;
  NEF_ASSERT(lead < 3);
  const bool flip = plane[lead] < 0;
  std::array<Int128, 5> row = plane;
  if (flip) {
    for (Int128& value : row) value = -value;
  }
  rows_.push(row);
  const PlaneId result = find_or_add_last([&row] {
    const int top = bit_width(magnitude(row[0]) | magnitude(row[1]) | magnitude(row[2]));
    const double offset = row[4] == 0 ? scaled(row[3], top) : (row[4] > 0 ? HUGE_VAL : -HUGE_VAL);
    return std::array<double, 4>{scaled(row[0], top), scaled(row[1], top), scaled(row[2], top), offset};
  });
  return flip ? result.opposite() : result;
}

PlaneId PlaneTable::intern_from(const PlaneTable& other, PlaneId plane) {
  if (&other == this) return plane;
  // The other row is normalized already; only its place in this table is in question.
  make_room_for(1);
  const std::uint32_t hash = RowSlots::hash_of(other.rows_, plane.row());
  RowSlots::Slot& slot = slots_.find(rows_, hash, other.rows_, plane.row());
  if (!slot.empty()) return PlaneId{slot.row << 1U | (plane.value & 1U)};
  const std::uint32_t row = rows_.push_from(other.rows_, plane.row());
  slot = {row, hash};
  approximate_.push_back(other.approximate_[plane.row()]);
  return PlaneId{row << 1U | (plane.value & 1U)};
}

// Slots are all over a large table, so all are fetched before the first one is looked at.
std::vector<std::uint32_t> PlaneTable::intern_all(const PlaneTable& other) {
  NEF_ASSERT(&other != this);
  const std::size_t count = other.size();
  make_room_for(count);
  std::vector<std::uint32_t> hashes(count);
  for (std::uint32_t row = 0; row < count; ++row) {
    hashes[row] = RowSlots::hash_of(other.rows_, row);
    slots_.prefetch(hashes[row]);
  }
  std::vector<std::uint32_t> result(count);
  for (std::uint32_t row = 0; row < count; ++row) {
    const RowSlots::Slot& slot = std::as_const(slots_).find(rows_, hashes[row], other.rows_, row);
    result[row] = slot.empty() ? kNotHere : slot.row;
  }
  for (std::size_t first = 0; first < count; ++first) {
    std::size_t last = first;
    for (auto row = static_cast<std::uint32_t>(size()); last < count && result[last] == kNotHere; ++last, ++row) {
      result[last] = row;
      slots_.add_new(row, hashes[last]);
    }
    if (last == first) continue;
    append(other, first, last - first);
    first = last;
  }
  return result;
}

std::uint32_t PlaneTable::append_new(const PlaneTable& other, std::uint32_t row) {
  slots_.clear();
  approximate_.push_back(other.approximate_[row]);
  return rows_.push_from(other.rows_, row);
}

void PlaneTable::append_new(const PlaneTable& other, std::size_t first, std::size_t count) {
  slots_.clear();
  append(other, first, count);
}

void PlaneTable::append(const PlaneTable& other, std::size_t first, std::size_t count) {
  const auto from = other.approximate_.begin() + static_cast<std::ptrdiff_t>(first);
  approximate_.insert(approximate_.end(), from, from + static_cast<std::ptrdiff_t>(count));
  rows_.append(other.rows_, first, count);
}

// Rows of one table are different, so that each equals at most one of the other. The smaller table is put into slots,
// and the rows of the larger one are looked up.
std::vector<std::uint32_t> PlaneTable::rows_of(const PlaneTable& other, const Monitor& monitor) const {
  constexpr std::size_t kTogether = 4096;
  std::vector<std::uint32_t> result(other.size(), kNotHere);
  if (other.size() == 0 || size() == 0) return result;
  const bool other_is_smaller = other.size() < size();
  const IntegerRows& few = other_is_smaller ? other.rows_ : rows_;
  const IntegerRows& many = other_is_smaller ? rows_ : other.rows_;
  std::vector<std::uint32_t> hashes(few.size());
  parallel_for_ranges(few.size(), kTogether, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    for (auto row = static_cast<std::uint32_t>(first); row < last; ++row) hashes[row] = RowSlots::hash_of(few, row);
  });
  RowSlots slots;
  slots.reserve(few.size());
  for (std::uint32_t row = 0; row < few.size(); ++row) slots.add_new(row, hashes[row]);
  parallel_for_ranges(many.size(), kTogether, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
    for (auto row = static_cast<std::uint32_t>(first); row < last; ++row) {
      const RowSlots::Slot& equal = std::as_const(slots).find(few, RowSlots::hash_of(many, row), many, row);
      if (equal.empty()) continue;
      (other_is_smaller ? result[equal.row] : result[row]) = other_is_smaller ? row : equal.row;
    }
  });
  return result;
}

void PlaneTable::append_missing(const PlaneTable& other, std::vector<std::uint32_t>& rows) {
  for (std::uint32_t first = 0; first < rows.size(); ++first) {
    std::uint32_t last = first;
    for (auto row = static_cast<std::uint32_t>(size()); last < rows.size() && rows[last] == kNotHere; ++last) {
      rows[last] = row++;
    }
    if (last == first) continue;
    append_new(other, first, last - first);
    first = last;
  }
}

PlaneId PlaneTable::intern(const Rational3& normal, const Rational& offset) {
  Integer denominator = offset.get_den();
  for (const Rational& n : normal) mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(), n.get_den().get_mpz_t());
  const auto scale = [&denominator](const Rational& value) {
    return Integer(value.get_num() * (denominator / value.get_den()));
  };
  return intern(scale(normal[0]), scale(normal[1]), scale(normal[2]), scale(offset));
}

Integer PlaneTable::oriented_coefficient(PlaneId plane, std::size_t column) const {
  Integer result;
  mpz_set(result.get_mpz_t(), coefficient(plane, column));
  return plane.flipped() ? Integer(-result) : result;
}

PlaneId PlaneTable::find_or_add_last() {
  return find_or_add_last([this] {
    const std::array<IntegerView, 5> row = rows_.first<5>(static_cast<std::uint32_t>(rows_.size() - 1));
    long top = std::numeric_limits<long>::min();
    for (std::size_t i = 0; i < 3; ++i) {
      if (row[i].sign() != 0) top = std::max(top, bits_of(row[i]));
    }
    std::array<double, 4> result{};
    for (std::size_t i = 0; i < 4; ++i) result[i] = scaled(row[i], top);
    if (row[4].sign() != 0) result[3] = row[4].sign() > 0 ? HUGE_VAL : -HUGE_VAL;
    // What is lost here may be all that matters at a point far away.
    constexpr double kLeast = 0x1p-1000;
    for (std::size_t i = 0; i < 3; ++i) {
      if (row[i].sign() != 0 && std::fabs(result[i]) < kLeast) result[3] = HUGE_VAL;
    }
    return result;
  });
}

void PlaneTable::make_room_for(std::size_t more) {
  const std::size_t planes = approximate_.size();  // a candidate is not among them
  if (2 * (planes + more) <= slots_.size()) return;
  const bool anew = slots_.size() == 0;
  slots_.reserve(std::max({2 * planes + 4, planes + more, approximate_.capacity()}));
  if (!anew) return;
  for (std::uint32_t row = 0; row < planes; ++row) slots_.add_new(row, RowSlots::hash_of(rows_, row));
}

std::size_t PlaneTable::bytes() const { return rows_.bytes() + held_bytes(approximate_) + slots_.bytes(); }

}  // namespace nef
