// SPDX-License-Identifier: Apache-2.0
//
// Integers of two machine words, which g++ and clang have and the standard has not, and what small integers need.
#pragma once

#include <algorithm>
#include <bit>
#include <compare>
#include <cstdint>
#include <utility>

#include "nef/number/number.h"

namespace nef {

__extension__ using Int128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;

inline Unsigned128 magnitude(Int128 value) {
  return value < 0 ? -static_cast<Unsigned128>(value) : static_cast<Unsigned128>(value);
}

/// Sets an integer of GMP, whose limbs are words of 64 bits, to such a value.
inline void assign(Integer& to, Int128 value) {
  static_assert(GMP_NUMB_BITS == 64);
  const Unsigned128 size = magnitude(value);
  mp_limb_t* const limbs = mpz_limbs_write(to.get_mpz_t(), 2);
  limbs[0] = static_cast<mp_limb_t>(size);
  limbs[1] = static_cast<mp_limb_t>(size >> 64U);
  mpz_limbs_finish(to.get_mpz_t(), value < 0 ? -2 : 2);
}

inline int sign_of(Int128 value) { return (value > 0) - (value < 0); }

/// The number of bits of a value: 0 for 0.
inline int bit_width(Unsigned128 value) {
  const auto high = static_cast<std::uint64_t>(value >> 64U);
  return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                   : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(value)));
}

/// The greatest common divisor; 0 of two zeros. By Stein's algorithm: O(bits), and each step without a branch, of which
/// std::gcd has one that nobody could foresee. What a step waits for is short: the difference has as many zeros at its
/// end as its opposite, and its sign is that of a number below 2^63.
inline std::uint64_t greatest_common_divisor(std::uint64_t a, std::uint64_t b) {
  if (a == 0 || b == 0) return a | b;
  const int twos = std::countr_zero(a | b);
  a >>= static_cast<unsigned>(std::countr_zero(a));
  b >>= static_cast<unsigned>(std::countr_zero(b));
  while (a != b && (a | b) >> 63U != 0) {
    if (a < b) std::swap(a, b);
    a -= b;
    a >>= static_cast<unsigned>(std::countr_zero(a));
  }
  while (a != b) {
    const std::uint64_t difference = a - b;
    const auto mask = static_cast<std::uint64_t>(static_cast<std::int64_t>(difference) >> 63);  // turns it around
    b += difference & mask;                                                                     // the smaller one
    a = ((difference ^ mask) - mask) >> static_cast<unsigned>(std::countr_zero(difference));
  }
  return a << static_cast<unsigned>(twos);
}

/// Of a positive number. std::has_single_bit counts all bits, by a call on machines of the oldest kind.
inline bool is_power_of_two(std::int64_t value) { return (value & (value - 1)) == 0; }

/// The greatest common divisor of a positive number and any other one; at once if the first is a power of two, as
/// denominators of doubles are.
inline std::int64_t common_divisor(std::int64_t denominator, std::int64_t value) {
  if (!is_power_of_two(denominator)) {
    const auto size = value < 0 ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    return static_cast<std::int64_t>(greatest_common_divisor(static_cast<std::uint64_t>(denominator), size));
  }
  if (value == 0) return denominator;
  return std::int64_t{1} << std::min(std::countr_zero(static_cast<std::uint64_t>(denominator)),
                                     std::countr_zero(static_cast<std::uint64_t>(value)));
}

/// The same for a longer number.
inline std::int64_t common_divisor(std::int64_t denominator, Int128 value) {
  if (is_power_of_two(denominator)) {
    return common_divisor(denominator, static_cast<std::int64_t>(static_cast<Unsigned128>(value) &
                                                                 static_cast<Unsigned128>(denominator - 1)));
  }
  return common_divisor(denominator, static_cast<std::int64_t>(value % denominator));
}

/// a b of two words each, in four.
struct WideProduct {
  Unsigned128 high = 0;
  Unsigned128 low = 0;
  auto operator<=>(const WideProduct&) const = default;
};
inline WideProduct wide_product(Unsigned128 a, Unsigned128 b) {
  const auto a0 = static_cast<std::uint64_t>(a);
  const auto a1 = static_cast<std::uint64_t>(a >> 64U);
  const auto b0 = static_cast<std::uint64_t>(b);
  const auto b1 = static_cast<std::uint64_t>(b >> 64U);
  const Unsigned128 lowest = static_cast<Unsigned128>(a0) * b0;
  const Unsigned128 cross = static_cast<Unsigned128>(a1) * b0;
  // Below 2^128: the largest product of two words leaves room for two words.
  const Unsigned128 middle = static_cast<Unsigned128>(a0) * b1 + static_cast<std::uint64_t>(cross) + (lowest >> 64U);
  return {static_cast<Unsigned128>(a1) * b1 + (cross >> 64U) + (middle >> 64U),
          middle << 64U | static_cast<std::uint64_t>(lowest)};
}

/// The sign of a b - c d. The magnitudes are below 2^127.
inline int compare_products(Int128 a, Int128 b, Int128 c, Int128 d) {
  const Unsigned128 all = magnitude(a) | magnitude(b) | magnitude(c) | magnitude(d);
  if (all >> 63U == 0) return sign_of(a * b - c * d);
  const int left = sign_of(a) * sign_of(b);
  const int right = sign_of(c) * sign_of(d);
  if (left != right) return left > right ? 1 : -1;
  const WideProduct x = wide_product(magnitude(a), magnitude(b));
  const WideProduct y = wide_product(magnitude(c), magnitude(d));
  return left * ((x > y) - (x < y));
}

}  // namespace nef
