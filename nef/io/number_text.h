// SPDX-License-Identifier: Apache-2.0
//
// Numbers as text and as bytes, appended to a string.
#pragma once

#include <bit>
#include <charconv>
#include <cstdint>
#include <string>
#include <type_traits>

#include "nef/number/number.h"

namespace nef {

/// Appends the shortest decimal that reads back as the same float or double, or an integer.
template <typename Number>
void append_number(std::string& text, Number value) {
  char buffer[40];
  if constexpr (std::is_floating_point_v<Number>) {
    if (value == 0) value = 0;  // no "-0"
  }
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  text.append(buffer, end);
}

/// Appends the decimal digits of a GMP integer.
inline void append_integer(std::string& text, mpz_srcptr value) {
  if (mpz_fits_slong_p(value) != 0) {
    append_number(text, mpz_get_si(value));
    return;
  }
  const std::size_t old = text.size();
  text.resize(old + mpz_sizeinbase(value, 10) + 2);
  mpz_get_str(text.data() + old, 10, value);
  text.resize(text.find('\0', old));
}

/// Appends the bytes of a value, little end first.
template <typename Value>
void append_little_endian(std::string& bytes, Value value) {
  if constexpr (std::is_same_v<Value, float>) {
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
  } else if constexpr (std::is_same_v<Value, double>) {
    append_little_endian(bytes, std::bit_cast<std::uint64_t>(value));
  } else {
    for (std::size_t i = 0; i < sizeof(Value); ++i) bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
  }
}

}  // namespace nef
