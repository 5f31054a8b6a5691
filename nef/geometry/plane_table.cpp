// SPDX-License-Identifier: Apache-2.0
//
// Coefficients are divided by their common factor and made positive in the first non-zero component of the normal, so
// equal planes have equal rows; a hash table with open addressing, at most half full, finds them. It is filled when the
// first plane is looked for, since most finished tables are only read. Tables are compared in bulk: hashes of the
// smaller table are put into slots, on several threads, and the rows of the larger one are looked up. Where planes are
// merged at the end, a bit for each hash tells nearly all that equal no other one.
#include "nef/geometry/plane_table.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/number/int128.h"

namespace nef {

// The candidate is the last row; keep it only if no equal row exists.
PlaneId PlaneTable::find_or_add_last() {
  const auto candidate = static_cast<std::uint32_t>(rows_.size() - 1);
  if (!merges_) return PlaneId::of_row(candidate);
  make_room_for(1, candidate);
  const std::uint32_t hash = RowSlots::hash_of(rows_, candidate);
  RowSlots::Slot& slot = slots_.find(rows_, hash, rows_, candidate);
  if (!slot.empty()) {
    rows_.pop();
    return PlaneId::of_row(slot.row);
  }
  slot = {candidate, hash};
  return PlaneId::of_row(candidate);
}

void PlaneTable::keep(std::span<const std::uint8_t> used) {
  slots_.clear();
  rows_.keep(used);
}

void PlaneTable::trim() {
  rows_.trim();
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
  const PlaneId result = find_or_add_last();
  return flip ? result.opposite() : result;
}

PlaneId PlaneTable::intern_from(const PlaneTable& other, PlaneId plane) {
  if (&other == this) return plane;
  // The other row is normalized already; only its place in this table is in question.
  make_room_for(1, size());
  const std::uint32_t hash = RowSlots::hash_of(other.rows_, plane.row());
  RowSlots::Slot& slot = slots_.find(rows_, hash, other.rows_, plane.row());
  if (!slot.empty()) return plane.in_row(slot.row);
  const auto row = static_cast<std::uint32_t>(size());
  rows_.push_from(other.rows_, plane.row());
  slot = {row, hash};
  return plane.in_row(row);
}

// Slots are all over a large table, so all are fetched before the first one is looked at.
std::vector<std::uint32_t> PlaneTable::intern_all(const PlaneTable& other) {
  NEF_ASSERT(&other != this);
  const std::size_t count = other.size();
  make_room_for(count, size());
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
    rows_.append(other.rows_, first, last - first);
    first = last;
  }
  return result;
}

void PlaneTable::merge_later() {
  slots_.clear();
  merges_ = false;
}

namespace {

std::vector<std::uint32_t> hashes_of(const PlaneRows& rows, const Monitor& monitor) {
  return vector_of(rows.size(), monitor,
                   [&rows](std::size_t row) { return RowSlots::hash_of(rows, static_cast<std::uint32_t>(row)); });
}

// The rows whose hash another one has, too, and few others: those whose hash sets a bit that was set before.
std::vector<std::uint32_t> rows_of_common_hash(std::span<const std::uint32_t> hashes) {
  constexpr std::size_t kBits = 8;  // for each row: few enough for a cache, and few rows share one
  const std::size_t count = std::bit_ceil(std::max<std::size_t>(kBits * hashes.size(), 64));
  struct Bits {
    std::uint64_t once = 0;
    std::uint64_t twice = 0;
  };
  std::vector<Bits> bits(count / 64);
  const auto word = [&bits, count](std::uint32_t hash) -> Bits& { return bits[(hash & (count - 1)) / 64]; };
  const auto bit = [](std::uint32_t hash) { return std::uint64_t{1} << (hash % 64); };
  for (const std::uint32_t hash : hashes) {
    Bits& at = word(hash);
    at.twice |= at.once & bit(hash);
    at.once |= bit(hash);
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t row = 0; row < hashes.size(); ++row) {
    if ((word(hashes[row]).twice & bit(hashes[row])) != 0) result.push_back(row);
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> PlaneTable::merge_equal(const Monitor& monitor) {
  merges_ = true;
  const auto count = static_cast<std::uint32_t>(size());
  const std::vector<std::uint32_t> hashes = hashes_of(rows_, monitor);
  const std::vector<std::uint32_t> candidates = rows_of_common_hash(hashes);
  if (candidates.empty()) return {};
  RowSlots slots;
  slots.reserve(candidates.size());
  std::vector<std::uint32_t> first_equal;  // of each candidate
  std::size_t equal = 0;
  for (const std::uint32_t row : candidates) {
    RowSlots::Slot& slot = slots.find(rows_, hashes[row], rows_, row);
    if (slot.empty()) slot = {row, hashes[row]};
    first_equal.push_back(slot.row);
    equal += slot.row != row ? 1 : 0;
  }
  if (equal == 0) return {};
  std::vector<std::uint32_t> result(count);
  std::vector<std::uint8_t> used(count, 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) used[candidates[i]] = first_equal[i] == candidates[i] ? 1 : 0;
  for (std::uint32_t row = 0, kept = 0; row < count; ++row) result[row] = used[row] != 0 ? kept++ : kNotHere;
  for (std::size_t i = 0; i < candidates.size(); ++i) result[candidates[i]] = result[first_equal[i]];
  keep(used);
  return result;
}

std::uint32_t PlaneTable::append_new(const PlaneTable& other, std::uint32_t row) {
  slots_.clear();
  rows_.push_from(other.rows_, row);
  return static_cast<std::uint32_t>(size() - 1);
}

void PlaneTable::append_new(const PlaneTable& other, std::size_t first, std::size_t count) {
  slots_.clear();
  rows_.append(other.rows_, first, count);
}

// Rows of one table are different, so that each equals at most one of the other. The smaller table is put into slots,
// and the rows of the larger one are looked up.
std::vector<std::uint32_t> PlaneTable::rows_of(const PlaneTable& other, const Monitor& monitor) const {
  constexpr std::size_t kTogether = 4096;
  std::vector<std::uint32_t> result(other.size(), kNotHere);
  if (other.size() == 0 || size() == 0) return result;
  const bool other_is_smaller = other.size() < size();
  const PlaneRows& few = other_is_smaller ? other.rows_ : rows_;
  const PlaneRows& many = other_is_smaller ? rows_ : other.rows_;
  const std::vector<std::uint32_t> hashes = hashes_of(few, monitor);
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

// Beside so many of the planes, which a candidate is not among.
void PlaneTable::make_room_for(std::size_t more, std::size_t planes) {
  if (2 * (planes + more) <= slots_.size()) return;
  const bool anew = slots_.size() == 0;
  slots_.reserve(std::max({2 * planes + 4, planes + more, rows_.capacity()}));
  if (!anew) return;
  for (std::uint32_t row = 0; row < planes; ++row) slots_.add_new(row, RowSlots::hash_of(rows_, row));
}

std::size_t PlaneTable::bytes() const { return rows_.bytes() + slots_.bytes(); }

}  // namespace nef
