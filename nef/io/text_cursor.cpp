// SPDX-License-Identifier: Apache-2.0
//
// A decimal of up to 19 digits, or of 20 and below 2^64, fits into 64 bits, and so does the power of five of up to 27
// places: the fraction is reduced by shifting out twos and dividing out fives, because ten has no other factors, and no
// GMP division is needed. All other numbers are left to `try_parse_rational`.
#include "nef/io/text_cursor.h"

#include <array>
#include <bit>
#include <charconv>

namespace nef {
namespace {

constexpr int kMaxDigits = 19;  // 10^19 < 2^64
constexpr int kMaxScale = 27;   // 5^27 < 2^63

template <int kMost>
constexpr std::array<std::uint64_t, kMost + 1> powers_of(std::uint64_t base) {
  std::array<std::uint64_t, kMost + 1> result{};
  result[0] = 1;
  for (std::size_t i = 1; i < result.size(); ++i) result[i] = result[i - 1] * base;
  return result;
}
constexpr auto kPowerOfTen = powers_of<kMaxDigits>(10);
constexpr auto kPowerOfFive = powers_of<kMaxScale>(5);

constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// True if a number of so many digits, the first of which is not 0, is below 2^64; given that number modulo 2^64. One of
// 20 digits that begins with 1 is below 2 10^19, and so 10^19 or more as long as it is below 2^64, and less behind it.
bool is_short(int digits, char first, std::uint64_t modulo) {
  return digits <= kMaxDigits || (digits == kMaxDigits + 1 && first == '1' && modulo >= kPowerOfTen[kMaxDigits]);
}

// Of each byte, whether it ends a word.
constexpr std::array<bool, 256> kEndsWord = [] {
  std::array<bool, 256> result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const char c = static_cast<char>(i);
    result[i] = is_space(c) || c == '\n' || c == '#';
  }
  return result;
}();

// mantissa / 10^scale in lowest terms: ten has no prime factors but two and five.
void assign_decimal(bool negative, std::uint64_t mantissa, int scale, Rational& value) {
  if (mantissa == 0) scale = 0;
  int twos = scale;
  int fives = scale;
  if (scale > 0) {
    const int common = std::min(twos, std::countr_zero(mantissa));
    mantissa >>= static_cast<unsigned>(common);
    twos -= common;
    while (fives > 0 && mantissa % 5 == 0) {
      mantissa /= 5;
      --fives;
    }
  }
  mpz_set_ui(value.get_num_mpz_t(), mantissa);
  if (negative) mpz_neg(value.get_num_mpz_t(), value.get_num_mpz_t());
  const std::uint64_t odd = kPowerOfFive[static_cast<std::size_t>(fives)];
  if (std::bit_width(odd) + twos <= 64) {
    mpz_set_ui(value.get_den_mpz_t(), odd << static_cast<unsigned>(twos));
  } else {
    mpz_set_ui(value.get_den_mpz_t(), odd);
    mpz_mul_2exp(value.get_den_mpz_t(), value.get_den_mpz_t(), static_cast<mp_bitcnt_t>(twos));
  }
}

// True if `text` is a decimal that fits into 64-bit arithmetic; everything else is left to parse_rational.
bool parse_short_decimal(std::string_view text, Rational& value) {
  const char* p = text.data();
  const char* const end = p + text.size();
  bool negative = false;
  if (p != end && (*p == '-' || *p == '+')) negative = *p++ == '-';
  std::uint64_t mantissa = 0;
  int digits = 0;  // from the first one on that is not zero
  char first = '0';
  bool is_number = false;
  const auto take_digits = [&] {
    for (; p != end && is_digit(*p); ++p) {
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');  // of more digits, modulo 2^64
      if (digits == 0) first = *p;
      if (first != '0') ++digits;
      is_number = true;
    }
  };
  take_digits();
  int scale = 0;
  if (p != end && *p == '.') {
    const char* const point = ++p;
    take_digits();
    scale = static_cast<int>(p - point);
  }
  if (!is_number || text.size() > 30 || !is_short(digits, first, mantissa)) return false;
  if (p != end && (*p == 'e' || *p == 'E')) {
    int exponent = 0;
    const char* from = p + 1;
    if (from != end && *from == '+') ++from;
    const auto [stop, error] = std::from_chars(from, end, exponent);
    if (error != std::errc() || stop != end || exponent > 100 || exponent < -100) return false;
    p = end;
    scale -= exponent;
  }
  if (p != end || scale > kMaxScale) return false;
  if (scale < 0) {
    if (digits - scale > kMaxDigits) return false;
    mantissa *= kPowerOfTen[static_cast<std::size_t>(-scale)];
    scale = 0;
  }
  assign_decimal(negative, mantissa, scale, value);
  return true;
}

}  // namespace

bool parse_number(std::string_view text, Rational& value) {
  if (parse_short_decimal(text, value)) return true;
  std::optional<Rational> parsed = try_parse_rational(text);
  if (!parsed) return false;
  value = *std::move(parsed);
  return true;
}

std::string_view TextCursor::take() {
  const char* const first = text_.data() + position_;
  const char* const end = text_.data() + text_.size();
  const char* p = first;
  while (p != end && !kEndsWord[static_cast<unsigned char>(*p)]) ++p;
  position_ += static_cast<std::size_t>(p - first);
  return {first, static_cast<std::size_t>(p - first)};
}

std::string_view TextCursor::word_in_line() {
  while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  if (position_ < text_.size() && text_[position_] == '#') {
    const std::size_t end = text_.find('\n', position_);
    position_ = end == std::string_view::npos ? text_.size() : end;
  }
  return take();
}

std::string_view TextCursor::word() {
  for (;;) {
    const std::string_view found = word_in_line();
    if (!found.empty() || position_ >= text_.size()) return found;
    skip_line();
  }
}

void TextCursor::skip_line() {
  const std::size_t end = text_.find('\n', position_);
  if (end == std::string_view::npos) {
    position_ = text_.size();
  } else {
    position_ = end + 1;
    ++line_;
  }
}

bool TextCursor::line_done() {
  const std::size_t position = position_;
  const bool done = word_in_line().empty();
  position_ = position;
  return done;
}

bool TextCursor::at_end() {
  while (position_ < text_.size() && line_done()) {
    skip_line();
  }
  return position_ >= text_.size();
}

void TextCursor::number(Rational& value, std::string_view what, std::size_t index, FileElement element) {
  const std::string_view found = word();
  if (found.empty()) {
    fail(FileProblem::kTruncated, "the file ends where the " + std::string(what) + " " + std::to_string(index) +
                                      " should be; it is truncated, or its header announces too much");
  }
  parse(found, value, what, index, element);
}

void TextCursor::parse(std::string_view word, Rational& value, std::string_view what, std::size_t index,
                       FileElement element) const {
  if (parse_number(word, value)) return;
  fail(FileProblem::kNotANumber,
       std::string(what) + " " + std::to_string(index) + " is " + in_quotes(word) +
           ", not a finite number; write it like -3, 0.25, 1e-3 or 1/3",
       element);
}

std::int64_t TextCursor::integer(std::string_view what) {
  const std::string_view found = word();
  if (found.empty()) {
    fail(FileProblem::kTruncated, "the file ends where the " + std::string(what) +
                                      " should be; it is truncated, or its header announces too much");
  }
  return parse_integer(found, what);
}

std::int64_t TextCursor::parse_integer(std::string_view word, std::string_view what) const {
  std::int64_t value = 0;
  const char* first = word.data();
  const char* const last = first + word.size();
  if (first != last && *first == '+') ++first;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error != std::errc() || stop != last) {
    fail(FileProblem::kSyntax, "the " + std::string(what) + " is " + in_quotes(word) + ", not a whole number");
  }
  return value;
}

void TextCursor::fail(FileProblem problem, const std::string& what, FileElement element) const {
  throw FileError(problem, path_ + ":" + std::to_string(line_) + ": " + what, element);
}

}  // namespace nef
