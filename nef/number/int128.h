// SPDX-License-Identifier: Apache-2.0
//
// Integers of two machine words, which g++ and clang have and the standard has not, and what small integers need.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace nef {

__extension__ using Int128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;

inline Unsigned128 magnitude(Int128 value) {
  return value < 0 ? -static_cast<Unsigned128>(value) : static_cast<Unsigned128>(value);
}

inline int sign_of(Int128 value) { return (value > 0) - (value < 0); }

/// The number of bits of a value: 0 for 0.
inline int bit_width(Unsigned128 value) {
  const auto high = static_cast<std::uint64_t>(value >> 64U);
  return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                   : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(value)));
}

/// The greatest common divisor of a positive number and any other one; at once if the first is a power of two, as
/// denominators of doubles are.
inline std::int64_t common_divisor(std::int64_t denominator, std::int64_t value) {
  if (!std::has_single_bit(static_cast<std::uint64_t>(denominator))) return std::gcd(denominator, value);
  if (value == 0) return denominator;
  return std::int64_t{1} << std::min(std::countr_zero(static_cast<std::uint64_t>(denominator)),
                                     std::countr_zero(static_cast<std::uint64_t>(value)));
}

/// The same for a longer number.
inline std::int64_t common_divisor(std::int64_t denominator, Int128 value) {
  if (std::has_single_bit(static_cast<std::uint64_t>(denominator))) {
    return common_divisor(denominator, static_cast<std::int64_t>(static_cast<Unsigned128>(value) &
                                                                 static_cast<Unsigned128>(denominator - 1)));
  }
  return std::gcd(denominator, static_cast<std::int64_t>(value % denominator));
}

}  // namespace nef
