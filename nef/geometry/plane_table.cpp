// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/plane_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "nef/base/error.h"

namespace nef {
namespace {

constexpr std::uint32_t kEmpty = 0xffffffffU;

// mantissa * 2^(exponent - top), for a coefficient of the row; truncation by GMP is within 2^-52.
double scaled(mpz_srcptr value, long top) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value);
  const long shift = exponent - top;
  if (shift > 1023) return mantissa < 0 ? -HUGE_VAL : HUGE_VAL;
  if (shift < -1060) return 0.0;
  return std::ldexp(mantissa, static_cast<int>(shift));
}

std::uint32_t hash_of(const IntegerRows& rows, std::uint32_t row) {
  const std::uint64_t hash = rows.hash(row);
  return static_cast<std::uint32_t>(hash ^ hash >> 32U);
}

}  // namespace

// The slot of a row of `other`: it names an equal row, or is empty.
PlaneTable::Slot& PlaneTable::slot_of(std::uint32_t hash, const IntegerRows& other, std::uint32_t row) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].row != kEmpty && (slots_[at].hash != hash || !rows_.equal(slots_[at].row, other, row))) {
    at = (at + 1) & mask;
  }
  return slots_[at];
}

void PlaneTable::reserve(std::size_t planes) {
  rows_.reserve(planes, 5);
  approximate_.reserve(planes);
}

void PlaneTable::trim() {
  rows_.trim();
  if (approximate_.capacity() - approximate_.size() > approximate_.capacity() / 8) approximate_.shrink_to_fit();
  slots_ = std::vector<Slot>();  // an empty list would keep the memory
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
  mpz_t zero;
  mpz_roinit_n(zero, nullptr, 0);
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

PlaneId PlaneTable::intern_from(const PlaneTable& other, PlaneId plane) {
  if (&other == this) return plane;
  // The other row is normalized already; only its place in this table is in question.
  make_room_for_one();
  const std::uint32_t hash = hash_of(other.rows_, plane.row());
  Slot& slot = slot_of(hash, other.rows_, plane.row());
  if (slot.row != kEmpty) return PlaneId{slot.row << 1U | (plane.value & 1U)};
  const std::uint32_t row = rows_.push_from(other.rows_, plane.row());
  slot = {row, hash};
  approximate_.push_back(other.approximate_[plane.row()]);
  return PlaneId{row << 1U | (plane.value & 1U)};
}

std::uint32_t PlaneTable::append_new(const PlaneTable& other, std::uint32_t row) {
  slots_.clear();
  approximate_.push_back(other.approximate_[row]);
  return rows_.push_from(other.rows_, row);
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

// The candidate is the last row; keep it only if no equal row exists.
PlaneId PlaneTable::find_or_add_last() {
  const auto candidate = static_cast<std::uint32_t>(rows_.size() - 1);
  make_room_for_one();
  const std::uint32_t hash = hash_of(rows_, candidate);
  Slot& slot = slot_of(hash, rows_, candidate);
  if (slot.row != kEmpty) {
    rows_.pop();
    return PlaneId{slot.row << 1U};
  }
  slot = {candidate, hash};
  long top = std::numeric_limits<long>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    const IntegerView value = rows_.at(candidate, i);
    if (value.sign() != 0) top = std::max(top, static_cast<long>(mpz_sizeinbase(value, 2)));
  }
  std::array<double, 4> approximate{};
  for (std::size_t i = 0; i < 4; ++i) approximate[i] = scaled(rows_.at(candidate, i), top);
  if (rows_.sign(candidate, 4) != 0) approximate[3] = rows_.sign(candidate, 4) > 0 ? HUGE_VAL : -HUGE_VAL;
  approximate_.push_back(approximate);
  return PlaneId{candidate << 1U};
}

void PlaneTable::make_room_for_one() {
  const std::size_t planes = approximate_.size();  // a candidate is not among them
  if (2 * (planes + 1) > slots_.size()) make_slots(std::max(2 * planes + 4, approximate_.capacity()));
}

void PlaneTable::make_slots(std::size_t planes) {
  const std::size_t capacity = std::bit_ceil(std::max<std::size_t>(16, 2 * planes));
  if (capacity <= slots_.size()) return;
  const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(capacity, {kEmpty, 0}));
  const auto insert = [&](Slot entry) {
    std::size_t at = entry.hash & (capacity - 1);
    while (slots_[at].row != kEmpty) at = (at + 1) & (capacity - 1);
    slots_[at] = entry;
  };
  if (!old.empty()) {
    for (const Slot& entry : old) {
      if (entry.row != kEmpty) insert(entry);
    }
  } else {
    for (std::uint32_t row = 0; row < approximate_.size(); ++row) insert({row, hash_of(rows_, row)});
  }
}

std::size_t PlaneTable::bytes() const {
  return rows_.bytes() + approximate_.capacity() * sizeof(approximate_[0]) + slots_.capacity() * sizeof(slots_[0]);
}

}  // namespace nef
