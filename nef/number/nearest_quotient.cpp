// SPDX-License-Identifier: Apache-2.0
#include "nef/number/nearest_quotient.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "nef/number/int128.h"
#include "nef/number/number.h"

namespace nef {
namespace {

// (bits + e) 2^exponent with 0 <= e < 1 and the highest bit set.
struct Leading {
  std::uint64_t bits = 0;
  long exponent = 0;
};

Leading leading(mpz_srcptr x) {
  static_assert(GMP_NUMB_BITS == 64);
  const std::size_t size = mpz_size(x);
  const mp_limb_t* limbs = mpz_limbs_read(x);
  const int shift = std::countl_zero(limbs[size - 1]);
  std::uint64_t bits = limbs[size - 1] << static_cast<unsigned>(shift);
  if (shift > 0 && size > 1) bits |= limbs[size - 2] >> static_cast<unsigned>(64 - shift);
  return {bits, 64 * static_cast<long>(size - 1) - shift};
}

// The magnitude, from the leading 64 bits of both integers, if these decide how it is rounded.
//
// Let N and D be these bits. N / D, as the leading bits were cut off there, is within a factor of 1 +- 2^-63 of the
// truth; scaled to 64 bits that is less than 2, and q below is less than 1 under it. So the truth is in (q - 2, q + 3),
// and it is rounded as q is unless 2^10, half of what the last of 53 bits counts, lies between the ends.
std::optional<double> nearest_of_leading(mpz_srcptr numerator, mpz_srcptr denominator) {
  const Leading n = leading(numerator);
  const Leading d = leading(denominator);
  const unsigned shift = n.bits >= d.bits ? 63 : 64;
  const auto q = static_cast<std::uint64_t>((static_cast<Unsigned128>(n.bits) << shift) / d.bits);  // in [2^63, 2^64)
  const long exponent = n.exponent - d.exponent - static_cast<long>(shift) + 11;
  constexpr std::uint64_t kHalf = 1U << 10U;
  const std::uint64_t rest = q & (2 * kHalf - 1);
  if (rest > kHalf - 3 && rest < kHalf + 2) return std::nullopt;
  // Normal doubles only, so that these 53 bits are those to keep.
  if (exponent < -1022 || exponent > 970) return std::nullopt;
  const auto kept = static_cast<double>((q >> 11U) + (rest > kHalf ? 1 : 0));
  return kept * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

// The same where both integers are doubles, when the one rounding of IEEE arithmetic is the right one.
std::optional<double> nearest_of_short(mpz_srcptr numerator, mpz_srcptr denominator) {
  constexpr mp_limb_t kLimit = mp_limb_t{1} << 53U;
  if (mpz_size(numerator) > 1 || mpz_size(denominator) > 1) return std::nullopt;
  const mp_limb_t n = mpz_getlimbn(numerator, 0);
  const mp_limb_t d = mpz_getlimbn(denominator, 0);
  if (n > kLimit || d > kLimit) return std::nullopt;
  return static_cast<double>(n) / static_cast<double>(d);
}

// Division with remainder, of whatever size.
double nearest_by_division(mpz_srcptr n, mpz_srcptr denominator) {
  Integer numerator;
  mpz_abs(numerator.get_mpz_t(), n);
  // Scale so that the integer quotient has 55 or 56 bits: 53 to keep, the rest and the remainder
  // to decide the rounding.
  const long excess =
      static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(denominator, 2));
  const long shift = 55 - excess;
  Integer quotient;
  Integer remainder;
  if (shift >= 0) {
    numerator <<= static_cast<unsigned long>(shift);
    mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), numerator.get_mpz_t(), denominator);
  } else {
    Integer scaled;
    mpz_mul_2exp(scaled.get_mpz_t(), denominator, static_cast<unsigned long>(-shift));
    mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), numerator.get_mpz_t(), scaled.get_mpz_t());
  }
  const long bits = static_cast<long>(mpz_sizeinbase(quotient.get_mpz_t(), 2));
  // Below 2^-1022 fewer bits remain: the last kept bit is never under 2^-1074.
  long drop = bits - 53;
  if (bits - 1 - shift < -1022) drop = -1074 + shift;
  if (drop > bits + 1) return 0.0;
  Integer kept = quotient >> static_cast<unsigned long>(drop);
  const Integer rest = quotient - (kept << static_cast<unsigned long>(drop));
  const Integer half = Integer(1) << static_cast<unsigned long>(drop - 1);
  const int order = cmp(rest, half);
  const bool above = order > 0 || (order == 0 && remainder != 0);
  const bool tie = order == 0 && remainder == 0;
  if (above || (tie && mpz_odd_p(kept.get_mpz_t()) != 0)) kept += 1;
  return std::ldexp(kept.get_d(), static_cast<int>(drop - shift));
}

}  // namespace

double nearest_quotient(mpz_srcptr numerator, mpz_srcptr denominator) {
  const int sign = mpz_sgn(numerator);
  if (sign == 0) return 0.0;
  std::optional<double> magnitude = nearest_of_short(numerator, denominator);
  if (!magnitude) magnitude = nearest_of_leading(numerator, denominator);
  if (!magnitude) magnitude = nearest_by_division(numerator, denominator);
  return sign > 0 ? *magnitude : -*magnitude;
}

}  // namespace nef
