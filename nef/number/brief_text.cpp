// SPDX-License-Identifier: Apache-2.0
#include "nef/number/brief_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace nef {
namespace {

// An upper bound on the characters of a number, without converting it.
std::size_t most_characters(const Rational& value) {
  return mpz_sizeinbase(value.get_num_mpz_t(), 10) + mpz_sizeinbase(value.get_den_mpz_t(), 10) + 2;
}

// Seventeen digits of a number that is not zero, in the notation of doubles.
std::string scientific(const Rational& value) {
  constexpr mp_bitcnt_t kBits = 128;
  constexpr std::size_t kDigits = 17;
  mp_exp_t exponent = 0;
  const std::string digits = mpf_class(value, kBits).get_str(exponent, 10, kDigits);
  const std::size_t first = digits[0] == '-' ? 1 : 0;
  std::string text = digits.substr(0, first + 1);
  if (digits.size() > first + 1) text += "." + digits.substr(first + 1);
  return text + (exponent > 0 ? "e+" : "e") + std::to_string(exponent - 1);
}

}  // namespace

std::string brief_text(const Rational& value) {
  // mpz_sizeinbase may be one too large for each of the two.
  if (most_characters(value) <= kBriefNumber + 4) {
    std::string exact = to_string(value);
    if (exact.size() <= kBriefNumber) return exact;
  }
  const double nearest = nearest_double(value);
  if (!std::isfinite(nearest) || std::fabs(nearest) < std::numeric_limits<double>::min()) {
    return "about " + scientific(value);
  }
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), nearest).ptr;
  return "about " + std::string(text.data(), end);
}

std::string short_text(double value, int digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  return {text.data(), end};
}

std::string brief_text(const Integer& value) { return brief_text(Rational(value)); }

std::string brief_text(const Rational3& point) {
  return "(" + brief_text(point[0]) + ", " + brief_text(point[1]) + ", " + brief_text(point[2]) + ")";
}

}  // namespace nef
