// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace nef::fuzz {
namespace {

constexpr std::array<std::string_view, 40> kAwkward{"0",           "1",
                                                    "-1",          "2",
                                                    "3",           "*",
                                                    "65535",       "4294967295",
                                                    "4294967296",  "1e9",
                                                    "1e400",       "1e-400",
                                                    "1/0",         "1/3",
                                                    "-0",          "nan",
                                                    "inf",         "99999999999999999999",
                                                    "#",           "\"",
                                                    "{",           "}",
                                                    "[",           "]",
                                                    "end",         "vertex",
                                                    "facet",       "-",
                                                    "+3",          "c0",
                                                    "v1",          "l0",
                                                    "\xff",        std::string_view("\0", 1),
                                                    "\r\n",        "(",
                                                    ")",           ",",
                                                    "-2147483648", "0.1e-1"};

struct Range {
  std::size_t begin, length;
};

bool is_space(char c) { return c == ' ' || c == '\n' || c == ',' || c == '\t' || c == '(' || c == ')'; }

std::size_t place(Choices& choices, const std::string& text) {
  return choices.below(static_cast<std::uint32_t>(text.size()));
}

// The word around a random place; empty if there is white space.
Range random_word(Choices& choices, const std::string& text) {
  const std::size_t at = place(choices, text);
  std::size_t begin = at;
  while (begin > 0 && !is_space(text[begin - 1])) --begin;
  std::size_t end = at;
  while (end < text.size() && !is_space(text[end])) ++end;
  return {begin, end - begin};
}

Range random_line(Choices& choices, const std::string& text) {
  const std::size_t at = place(choices, text);
  const std::size_t before = text.rfind('\n', at);
  const std::size_t begin = before == std::string::npos || before >= at ? 0 : before + 1;
  const std::size_t after = text.find('\n', at);
  return {begin, (after == std::string::npos ? text.size() : after + 1) - begin};
}

std::string once(Choices& choices, std::string text) {
  if (text.empty()) return std::string(choices.element(kAwkward));
  switch (choices.below(12)) {
    case 0: {
      const Range word = random_word(choices, text);
      return text.replace(word.begin, word.length, choices.element(kAwkward));
    }
    case 1: {
      const Range word = random_word(choices, text);
      const Range other = random_word(choices, text);
      return text.replace(word.begin, word.length, text.substr(other.begin, other.length));
    }
    case 2: {
      const std::size_t at = place(choices, text);
      text[at] = static_cast<char>(choices.below(256));
      return text;
    }
    case 3: {
      const Range line = random_line(choices, text);
      return text.erase(line.begin, line.length);
    }
    case 4: {
      const Range line = random_line(choices, text);
      const Range other = random_line(choices, text);
      return text.insert(other.begin, text.substr(line.begin, line.length));
    }
    case 5:
      return text.substr(0, place(choices, text));
    case 6: {
      const std::size_t at = place(choices, text);
      return text.erase(at, 1 + choices.below(16));
    }
    case 7: {
      const std::size_t at = place(choices, text);
      return text.insert(at, choices.element(kAwkward));
    }
    default: {
      // A digit or sign for another one: what stays legal most often.
      const std::size_t at = text.find_first_of("0123456789", place(choices, text));
      if (at == std::string::npos) return text;
      text[at] = static_cast<char>('0' + choices.below(10));
      return text;
    }
  }
}

}  // namespace

std::string mutated(Choices& choices, std::string text) {
  for (std::uint32_t i = 1 + choices.below(4); i > 0; --i) text = once(choices, std::move(text));
  return text;
}

}  // namespace nef::fuzz
