// SPDX-License-Identifier: Apache-2.0
//
// Exact numbers: GMP integers and rationals, and how text and doubles become them.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace nef {

using Integer = mpz_class;
using Rational = mpq_class;

/// Three exact coordinates, or the three components of an exact vector; whole numbers mostly for directions.
using Rational3 = std::array<Rational, 3>;
using Integer3 = std::array<Integer, 3>;

/// The rational that `text` spells: "-3", "0.1" (one tenth), "1e-3", "1/3", "0.5/2.5". Nothing for anything else
/// ("nan", "inf", "", "1/0", trailing characters, an exponent of more than five digits).
std::optional<Rational> try_parse_rational(std::string_view text);

/// The same for callers with nothing to add to what is said of text that spells none: throws InputError.
Rational parse_rational(std::string_view text);

/// The rational that a finite double is. Throws InputError for a NaN or an infinity.
Rational exact_rational(double value);

/// The double nearest to `value` (round half to even; overflow gives an infinity, underflow
/// rounds to a subnormal or zero like any IEEE operation).
double nearest_double(const Rational& value);
/// The same of three coordinates.
inline std::array<double, 3> nearest_doubles(const Rational3& point) {
  return {nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])};
}

/// "p/q" in lowest terms, or "p" for an integer.
std::string to_string(const Rational& value);

/// A double within 2^-51 relative of numerator/denominator (denominator > 0). Never traps; may be
/// infinite or zero when the quotient leaves the range of normal doubles.
double approximate_quotient(mpz_srcptr numerator, mpz_srcptr denominator);

}  // namespace nef
