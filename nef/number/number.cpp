// SPDX-License-Identifier: Apache-2.0
#include "nef/number/number.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/number/nearest_quotient.h"

namespace nef {
namespace {

Integer power_of_ten(unsigned long exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, exponent);
  return result;
}

// A decimal without '/': sign, digits with at most one point, optional exponent.
std::optional<Rational> parse_decimal(std::string_view text) {
  std::size_t i = 0;
  bool negative = false;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative = text[i++] == '-';
  std::string digits;
  long scale = 0;
  bool point = false;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.' && !point) {
      point = true;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      digits.push_back(c);
      if (point) --scale;
    } else {
      break;
    }
  }
  if (digits.empty()) return std::nullopt;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    bool negative_exponent = false;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative_exponent = text[i++] == '-';
    const std::size_t first = i;
    long exponent = 0;
    for (; i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0; ++i) {
      // Five digits keep a hostile "1e999999999" from filling the memory with one number.
      if (i - first >= 5) return std::nullopt;
      exponent = exponent * 10 + (text[i] - '0');
    }
    if (i == first) return std::nullopt;
    scale += negative_exponent ? -exponent : exponent;
  }
  if (i != text.size()) return std::nullopt;
  Rational value{Integer(digits, 10)};
  if (scale > 0) {
    value *= power_of_ten(static_cast<unsigned long>(scale));
  } else if (scale < 0) {
    value /= power_of_ten(static_cast<unsigned long>(-scale));
  }
  return negative ? Rational(-value) : value;
}

}  // namespace

std::optional<Rational> try_parse_rational(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return parse_decimal(text);
  const std::optional<Rational> numerator = parse_decimal(text.substr(0, slash));
  const std::optional<Rational> denominator = parse_decimal(text.substr(slash + 1));
  if (!numerator || !denominator || *denominator == 0) return std::nullopt;
  return Rational(*numerator / *denominator);
}

Rational parse_rational(std::string_view text) {
  std::optional<Rational> value = try_parse_rational(text);
  if (!value) throw InputError(in_quotes(text) + " is not a number (write it like -3, 0.25, 1e-3 or 1/3)");
  return *std::move(value);
}

Rational exact_rational(double value) {
  if (!std::isfinite(value)) throw InputError("a coordinate is not a finite number");
  return Rational(value);
}

double nearest_double(const Rational& value) { return nearest_quotient(value.get_num_mpz_t(), value.get_den_mpz_t()); }

std::string to_string(const Rational& value) { return value.get_str(); }

double approximate_quotient(mpz_srcptr numerator, mpz_srcptr denominator) {
  if (mpz_size(numerator) <= 1 && mpz_size(denominator) == 1) {
    // Both conversions and the quotient round once: within 3 * 2^-53 relative.
    const double quotient =
        static_cast<double>(mpz_getlimbn(numerator, 0)) / static_cast<double>(mpz_getlimbn(denominator, 0));
    return (mpz_sgn(numerator) < 0) == (mpz_sgn(denominator) < 0) ? quotient : -quotient;  // zero has no sign
  }
  long numerator_exponent = 0;
  long denominator_exponent = 0;
  // mpz_get_d_2exp truncates: each mantissa is within 2^-52 relative, their quotient rounds once.
  const double n = mpz_get_d_2exp(&numerator_exponent, numerator);
  const double d = mpz_get_d_2exp(&denominator_exponent, denominator);
  const long exponent = numerator_exponent - denominator_exponent;
  if (exponent > 1100) return n < 0 ? -HUGE_VAL : HUGE_VAL;
  if (exponent < -1200) return 0.0;
  return std::ldexp(n / d, static_cast<int>(exponent));
}

}  // namespace nef
