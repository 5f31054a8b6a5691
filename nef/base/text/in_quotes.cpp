// SPDX-License-Identifier: Apache-2.0
#include "nef/base/text/in_quotes.h"

namespace nef {
namespace {

// The length of the UTF-8 sequence that `bytes` begins with; 0 if it begins with none.
std::size_t utf8_length(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first < 0xe0 ? 2 : first >= 0xe0 && first < 0xf0 ? 3 : 4;
  if (first < 0xc2 || first > 0xf4 || bytes.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  // Overlong forms, surrogates, and what lies beyond the last code point.
  const unsigned char second = byte(1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
      (first == 0xf4 && second > 0x8f)) {
    return 0;
  }
  return length;
}

}  // namespace

std::string utf8(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = utf8_length(bytes);
    if (length == 0) {
      text += "\xef\xbf\xbd";  // U+FFFD, the replacement character
      bytes.remove_prefix(1);
    } else {
      text += bytes.substr(0, length);
      bytes.remove_prefix(length);
    }
  }
  return text;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text = "'";
  std::size_t characters = 0;
  for (; !word.empty() && characters < kMost; ++characters) {
    const std::size_t length = utf8_length(word);
    const auto first = static_cast<unsigned char>(word[0]);
    if (length == 0 || first < 0x20 || first == 0x7f) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += "\\x";
      text += kDigits[first >> 4U];
      text += kDigits[first & 0xfU];
      word.remove_prefix(1);
    } else {
      text += word.substr(0, length);
      word.remove_prefix(length);
    }
  }
  if (!word.empty()) text += "...";
  return text + "'";
}

}  // namespace nef
